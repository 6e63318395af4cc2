#include "tools/mesh/convex_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "common/mesh/mesh.h"
#include "common/shape/catalogue.h"
#include "common/shape/surface.h"

namespace talus::convex_parts_test {
namespace {

Mesh surface_of(const Shape<3>& shape, int segments) {
  Mesh mesh;
  for (const Loop<3>& face : faces(shape, segments)) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      const int first = static_cast<int>(mesh.corners.size());
      mesh.corners.insert(mesh.corners.end(), {face[0], face[i], face[i + 1]});
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return repaired(mesh);
}

// A torus of radii 1 m and 0.3 m, `around` x 12 quads.
Mesh torus(int around) {
  const int across = 12;
  Mesh mesh;
  const auto number = [&](int i, int k) { return (i % around) * across + k % across; };
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < across; ++k) {
      const double u = 2.0 * std::numbers::pi * i / around;
      const double v = 2.0 * std::numbers::pi * k / across;
      const double radius = 1.0 + 0.3 * std::cos(v);
      mesh.corners.emplace_back(radius * std::cos(u), 0.3 * std::sin(v), radius * std::sin(u));
      mesh.triangles.push_back({number(i, k), number(i + 1, k), number(i + 1, k + 1)});
      mesh.triangles.push_back({number(i, k), number(i + 1, k + 1), number(i, k + 1)});
    }
  }
  return repaired(mesh);
}

double total_volume(const std::vector<Mesh>& parts) {
  double sum = 0.0;
  for (const Mesh& part : parts) sum += moments(part).volume;
  return sum;
}

TEST(ConvexParts, OfAConvexMeshIsOneThatFillsIt) {
  const Mesh ball = surface_of(make_shape<3>("ball", ball_pieces<3>(1.0), {}), 12);
  const std::vector<Mesh> parts = convex_parts(ball, {.parts = 1, .corners = 128});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NEAR(total_volume(parts) / moments(ball).volume, 1.0, 1e-6);
}

bool inside_one(const std::vector<Mesh>& parts, const Vec3& point) {
  return std::any_of(parts.begin(), parts.end(), [&](const Mesh& part) {
    return std::all_of(part.triangles.begin(), part.triangles.end(), [&](const std::array<int, 3>& triangle) {
      const auto corner = [&](std::size_t k) { return part.corners[triangle[k]]; };
      return (corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(point - corner(0)) <= 0.0;
    });
  });
}

// One hull of the torus has 1.65 times its volume; HACD's eight parts have 1.21 with what they overlap. They are hulls
// of patches of the surface, so narrow gaps may stay between them: one of the 64 places lies in such a gap.
TEST(ConvexParts, OfATorusFollowTheTubeAndLeaveTheHoleOpen) {
  const Mesh ring = torus(32);
  const std::vector<Mesh> parts = convex_parts(ring, {.parts = 8, .corners = 64});
  EXPECT_EQ(parts.size(), 8u);
  EXPECT_LT(total_volume(parts), 1.3 * moments(ring).volume);
  int covered = 0;
  for (int i = 0; i < 64; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 64;
    const Vec3 out(std::cos(angle), 0.0, std::sin(angle));
    covered += inside_one(parts, out) ? 1 : 0;
    EXPECT_FALSE(inside_one(parts, 0.5 * out)) << i;
  }
  EXPECT_GE(covered, 60);
}

TEST(ConvexParts, AreTheSameEveryTime) {
  const Mesh ring = torus(16);
  const std::vector<Mesh> once = convex_parts(ring, {});
  const std::vector<Mesh> again = convex_parts(ring, {});
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(content_hash(once[i]), content_hash(again[i]));
}

TEST(ConvexParts, RefuseNumbersOutOfRange) {
  const Mesh ring = torus(8);
  EXPECT_THROW(convex_parts(ring, {.parts = 0}), std::invalid_argument);
  EXPECT_THROW(convex_parts(ring, {.parts = 65}), std::invalid_argument);
  EXPECT_THROW(convex_parts(ring, {.corners = 3}), std::invalid_argument);
}

}  // namespace
}  // namespace talus::convex_parts_test

#include "tools/mesh/decomposition.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "common/mesh/mesh.h"
#include "common/mesh/mesh_file.h"
#include "common/mesh/parts_volume.h"
#include "common/shape/catalogue.h"
#include "common/shape/piece.h"
#include "common/shape/surface.h"

namespace talus::decomposition_test {
namespace {

/// The surface of a shape, its pieces as shells of their own.
Mesh surface_of(const std::vector<Piece<3>>& pieces, int segments = 24) {
  Mesh mesh;
  for (const Loop<3>& face : faces(make_shape<3>("any", pieces, {}), segments)) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      const int first = static_cast<int>(mesh.corners.size());
      mesh.corners.insert(mesh.corners.end(), {face[0], face[i], face[i + 1]});
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return repaired(mesh);
}

/// A prism of unit height; `cut` are the triangles of its outline.
Mesh prism(const std::vector<Vec2>& outline, const std::vector<std::array<int, 3>>& cut) {
  Mesh mesh;
  const int count = static_cast<int>(outline.size());
  for (int i = 0; i < 2 * count; ++i) {
    const Vec2& corner = outline[i % count];
    mesh.corners.emplace_back(corner.x(), corner.y(), i / count);
  }
  for (const auto& [a, b, c] : cut) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + count, b + count, c + count});
  }
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    mesh.triangles.push_back({i, next, next + count});
    mesh.triangles.push_back({i, next + count, i + count});
  }
  return repaired(mesh);
}

TEST(Decomposition, OfAConvexMeshIsOnePart) {
  const Mesh tetrahedron = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  for (const Mesh& mesh : {surface_of(box_pieces<3>({1, 1, 1})), surface_of(box_pieces<3>({2, 1, 1})), tetrahedron}) {
    const Decomposition result = decomposed(mesh, {});
    EXPECT_EQ(result.parts.size(), 1u);
    EXPECT_NEAR(result.ratio, 1.0, 1e-9);
  }
}

TEST(Decomposition, OfASphereIsOnePartOfFewerCorners) {
  const Mesh sphere = surface_of(ball_pieces<3>(1.0));
  const Decomposition result = decomposed(sphere, {});
  ASSERT_EQ(result.parts.size(), 1u);
  EXPECT_LT(result.parts[0].corners.size(), sphere.corners.size() / 2);
  EXPECT_GE(result.ratio, 0.95);
  EXPECT_LE(result.ratio, 1.0);
}

TEST(Decomposition, OfAMeshWithHollowsFillsIt) {
  const Mesh u = prism({{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                       {{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}, {0, 5, 6}, {0, 6, 7}});
  const Mesh l =
      prism({{0, 0}, {1, 0}, {1, 0.4}, {0.4, 0.4}, {0.4, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
  for (const Mesh& mesh : {u, l}) {
    const Decomposition result = decomposed(mesh, {});
    EXPECT_GE(result.parts.size(), 2u);
    EXPECT_NEAR(result.ratio, 1.0, parts_tolerance);
    for (const Mesh& part : result.parts) EXPECT_GE(smallest_width<3>(HullPiece<3>{part.corners}), thinnest_part);
  }
}

TEST(Decomposition, OfTheBunnyFillsIt) {
  const Mesh bunny = repaired(read_mesh(std::filesystem::path(TALUS_SOURCE_DIR) / "scenes/shapes/bunny.obj"));
  const Decomposition result = decomposed(bunny, {.parts = 24, .corners = 24});
  EXPECT_NEAR(result.ratio, 1.0, parts_tolerance);
  EXPECT_LT(result.parts.size(), 24u);
}

TEST(Decomposition, TellsTheLeastLongestSideAtWhichASceneAcceptsItsParts) {
  BoxPiece<3> plate;
  plate.half = {1.5, 1.5, 0.01};
  const Mesh mesh = surface_of({plate});
  const Decomposition result = decomposed(mesh, {});
  const double least = 0.05 * 3.0 / 0.02;
  EXPECT_GE(least_longest_side(mesh, result.parts), least);
  EXPECT_LE(least_longest_side(mesh, result.parts), 1.01 * least);
}

// Where shells overlap the mesh counts its volume twice, its parts do not.
TEST(Decomposition, ThatCannotHaveTheMeshsVolumeFails) {
  const BoxPiece<3> box;
  BoxPiece<3> beside;
  beside.pose.position = {0.2, 0.1, 0.1};
  const Mesh overlapping = surface_of({box, beside});
  EXPECT_THROW(decomposed(overlapping, {}), std::runtime_error);
}

}  // namespace
}  // namespace talus::decomposition_test

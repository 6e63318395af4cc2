// The camera, and which face is seen.

#include "tools/picture/projection.h"

#include <gtest/gtest.h>

#include "tools/picture/z_buffer.h"

namespace talus::projection_test {
namespace {

Projection<3> camera(double distance) {
  Projection<3> projection = Projection<3>::looking_along({1.0, -2.0, 0.8}, {3.0, 1.0, 0.5}, distance);
  projection.scale = 700.0;
  projection.shift = {400.0, 300.0};
  return projection;
}

TEST(Projection, ReturnsFromThePageToTheSamePoint) {
  const Vec3 point(2.0, 1.5, 1.0);
  for (const double distance : {0.0, 20.0}) {
    const Projection<3> projection = camera(distance);
    EXPECT_LT((projection.unproject(projection.project(point)) - point).norm(), 1e-12);
  }
}

TEST(Projection, ShowsUpAsUpAndNearerAsNearer) {
  for (const double distance : {0.0, 20.0}) {
    const Projection<3> projection = camera(distance);
    const Vec3 target = projection.project(projection.target);
    EXPECT_LT(projection.project(projection.target + Vec3::UnitZ()).y(), target.y());
    EXPECT_GT(projection.project(projection.target + Vec3(1.0, -2.0, 0.8)).z(), target.z());
  }
}

TEST(ZBuffer, ShowsTheNearerFaceWhateverTheOrder) {
  const auto square = [](double side, double height) {
    return Face{{{-side, -side, height}, {side, -side, height}, {side, side, height}, {-side, side, height}},
                Vec3::UnitZ(),
                0,
                {}};
  };
  Projection<3> above = Projection<3>::looking_along(Vec3::UnitZ(), Vec3::Zero(), 0.0);
  above.scale = 10.0;
  above.shift = {50.0, 50.0};
  for (const bool upper_first : {true, false}) {
    ZBuffer buffer(100, 100);
    buffer.add(upper_first ? square(1.0, 1.0) : square(3.0, 0.0), upper_first ? 1 : 0, above);
    buffer.add(upper_first ? square(3.0, 0.0) : square(1.0, 1.0), upper_first ? 0 : 1, above);
    EXPECT_EQ(buffer.face(50, 50), 1);
    EXPECT_EQ(buffer.face(65, 50), 0);
    EXPECT_EQ(buffer.face(95, 50), ZBuffer::nothing);
  }
}

TEST(ZBuffer, SharesNoPixelBetweenFacesOfACommonEdge) {
  // Two triangles of a square that covers 20 x 20 pixels, cut along an oblique line.
  const std::vector<Vec3> left = {{10.0, 10.0, 1.0}, {10.0, 30.0, 1.0}, {17.3, 30.0, 1.0}, {22.9, 10.0, 1.0}};
  const std::vector<Vec3> right = {{22.9, 10.0, 1.0}, {17.3, 30.0, 1.0}, {30.0, 30.0, 1.0}, {30.0, 10.0, 1.0}};
  constexpr int width = 100;
  std::vector<int> hits(static_cast<std::size_t>(width) * width, 0);
  for (const std::vector<Vec3>& half : {left, right}) {
    scan_convex(half, width, width, [&](int x, int y, double) {
      const int at = y * width + x;
      ++hits[at];
    });
  }
  EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), 400);
  EXPECT_EQ(std::count(hits.begin(), hits.end(), 2), 0);
}

TEST(ZBuffer, CutsOffWhatLiesBehindTheEye) {
  // Ground that reaches far behind a camera 20 m away.
  const Face ground = {{{-1e3, -1e3, 0.0}, {1e3, -1e3, 0.0}, {1e3, 1e3, 0.0}, {-1e3, 1e3, 0.0}}, Vec3::UnitZ(), -1, {}};
  ZBuffer buffer(800, 600);
  buffer.add(ground, 0, camera(20.0));
  EXPECT_EQ(buffer.face(400, 300), 0);
  for (const Vec3& corner : projected(ground, camera(20.0))) {
    EXPECT_TRUE(corner.allFinite());
    EXPECT_GT(corner.z(), 0.0);
  }
}

}  // namespace
}  // namespace talus::projection_test

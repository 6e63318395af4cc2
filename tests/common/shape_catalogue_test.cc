#include <gtest/gtest.h>

#include <numbers>

#include "common/shape/catalogue.h"

namespace talus {
namespace {

constexpr double tolerance = 1e-12;  // rounding only: the integrals are exact

TEST(LShape, HasTheAreaOfItsTwoArms) {
  const Shape<2> shape = make_shape("l", l_pieces<2>({}), {});
  EXPECT_NEAR(shape.volume, 1.0 * 0.4 + 0.4 * 0.6, tolerance);
  EXPECT_NEAR(shape.bounding_volume, 1.0, tolerance);
}

TEST(LShape, HasTheInertiaOfTheParallelAxisTheorem) {
  const Shape<2> shape = make_shape("l", l_pieces<2>({}), {.density = 1.0});
  const Vec2 centre = (0.4 * Vec2(0.5, 0.2) + 0.24 * Vec2(0.2, 0.7)) / 0.64;
  const double lying = 0.4 * (1.0 + 0.16) / 12.0 + 0.4 * (Vec2(0.5, 0.2) - centre).squaredNorm();
  const double standing = 0.24 * (0.16 + 0.36) / 12.0 + 0.24 * (Vec2(0.2, 0.7) - centre).squaredNorm();
  EXPECT_NEAR(shape.inertia(0, 0), lying + standing, tolerance);
  EXPECT_NEAR((shape.reference + centre).norm(), 0.0, tolerance);
}

TEST(Hull, OfABoxesCornersEqualsTheBox) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({(i & 1) != 0 ? 1.0 : 0.0, (i & 2) != 0 ? 2.0 : 0.0, (i & 4) != 0 ? 3.0 : 0.0});
  }
  const Shape<3> hull = make_shape("hull", hull_pieces<3>(corners), {});
  const Shape<3> box = make_shape("box", box_pieces<3>({1.0, 2.0, 3.0}), {});
  EXPECT_NEAR(hull.volume, box.volume, tolerance);
  EXPECT_LT((hull.inertia - box.inertia).norm(), tolerance * box.inertia.norm());
  EXPECT_TRUE(hull.bounds.isApprox(box.bounds));
}

}  // namespace
}  // namespace talus

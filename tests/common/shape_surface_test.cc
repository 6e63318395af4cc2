#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <numbers>

#include "common/shape/catalogue.h"
#include "common/shape/surface.h"
#include "tests/common/shape_generators.h"

namespace talus::shape_surface_test {
namespace {

using std::numbers::pi;

double area(const Loop<2>& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2& next = loop[(i + 1) % loop.size()];
    twice += loop[i].x() * next.y() - loop[i].y() * next.x();
  }
  return twice / 2.0;
}

Vec3 area_vector(const Loop<3>& loop) {
  Vec3 twice = Vec3::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i)
    twice += (loop[i] - loop[0]).cross(loop[(i + 1) % loop.size()] - loop[0]);
  return twice / 2.0;
}

// By the divergence theorem, for planar faces.
double volume(const std::vector<Loop<3>>& surface) {
  double sum = 0.0;
  for (const Loop<3>& loop : surface) sum += loop[0].dot(area_vector(loop)) / 3.0;
  return sum;
}

// Area of a regular polygon of n corners over its circle's.
double polygon_share(int n) { return n / (2.0 * pi) * std::sin(2.0 * pi / n); }

TEST(Outlines, OfAnLAreItsTwoArms) {
  const std::vector<Loop<2>> loops = outlines(make_shape("l", l_pieces<2>({}), {}), 4);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_NEAR(area(loops[0]), 0.4, 1e-12);
  EXPECT_NEAR(area(loops[1]), 0.24, 1e-12);
}

TEST(Outlines, OfADiscAreARegularPolygonOnTheCircle) {
  const std::vector<Loop<2>> loops = outlines(make_shape("disc", ball_pieces<2>(2.0), {}), 20);
  ASSERT_EQ(loops[0].size(), 20u);
  EXPECT_NEAR(area(loops[0]), 4.0 * pi * polygon_share(20), 1e-12);
}

TEST(Outlines, OfACapsuleHaveTwoHalvesOfARegularPolygonAtTheEnds) {
  const std::vector<Loop<2>> loops = outlines(make_shape("capsule", capsule_pieces<2>(5.0, 1.0), {}), 20);
  ASSERT_EQ(loops[0].size(), 22u);
  EXPECT_NEAR(area(loops[0]), 2.0 * 3.0 + pi * polygon_share(20), 1e-12);
}

TEST(Faces, OfABoxGivenAsAHullAreSixQuads) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({(i & 1) != 0 ? 1.0 : 0.0, (i & 2) != 0 ? 2.0 : 0.0, (i & 4) != 0 ? 3.0 : 0.0});
  const std::vector<Loop<3>> surface = faces(make_shape("hull", hull_pieces<3>(corners), {}), 4);
  ASSERT_EQ(surface.size(), 6u);
  for (const Loop<3>& loop : surface) EXPECT_EQ(loop.size(), 4u);
  EXPECT_NEAR(volume(surface), 6.0, 1e-12);
}

RC_GTEST_PROP(Faces, OfABoxGivenAsAHullAreSixHoweverItIsTurned, ()) {
  const HullPiece<3> hull = test::random_box_hull();
  RC_ASSERT(faces(make_shape<3>("hull", {hull}, {}), 4).size() == 6u);
}

// The inscribed body's volume falls short of the sphere's by order 1/segments^2.
TEST(Faces, OfASphereFillItBetterWithMoreSegments) {
  const Shape<3> sphere = make_shape("sphere", ball_pieces<3>(1.0), {});
  const double coarse = sphere.volume - volume(faces(sphere, 16));
  const double fine = sphere.volume - volume(faces(sphere, 32));
  EXPECT_GT(fine, 0.0);
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

TEST(Faces, OfACapsuleReachFromTipToTip) {
  const std::vector<Loop<3>> surface = faces(make_shape("capsule", capsule_pieces<3>(5.0, 1.0), {}), 8);
  Box<3> bounds;
  for (const Loop<3>& loop : surface)
    for (const Vec3& corner : loop) bounds.extend(corner);
  EXPECT_TRUE(bounds.isApprox(Box<3>(Vec3(-2.5, -1.0, -1.0), Vec3(2.5, 1.0, 1.0))));
}

TEST(Surface, RefusesSegmentsThatAreNoMultipleOfFour) {
  const Shape<2> disc = make_shape("disc", ball_pieces<2>(1.0), {});
  const Shape<3> sphere = make_shape("sphere", ball_pieces<3>(1.0), {});
  for (const int segments : {-4, 0, 3, 6}) {
    EXPECT_THROW(outlines(disc, segments), std::invalid_argument);
    EXPECT_THROW(faces(sphere, segments), std::invalid_argument);
  }
}

struct LessByAxis {
  bool operator()(const Vec3& a, const Vec3& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  }
};

// Each edge runs once each way: nothing is open, and all faces are turned alike.
RC_GTEST_PROP(Faces, AreClosedPlanarAndTurnedOutwards, ()) {
  const Shape<3> shape = make_shape<3>("any", {test::random_piece<3>()}, {});
  std::map<Vec3, int, LessByAxis> numbers;
  std::map<std::pair<int, int>, int> balance;
  const std::vector<Loop<3>> surface = faces(shape, 8);
  for (const Loop<3>& loop : surface) {
    const Vec3 normal = area_vector(loop).normalized();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      RC_ASSERT(std::abs(normal.dot(loop[i] - loop[0])) < 1e-10);
      const auto number = [&](const Vec3& corner) {
        return numbers.try_emplace(corner, static_cast<int>(numbers.size())).first->second;
      };
      const int from = number(loop[i]);
      const int to = number(loop[(i + 1) % loop.size()]);
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  for (const auto& [edge, sum] : balance) RC_ASSERT(sum == 0);
  // Eight segments fill 0.64 of a sphere's volume.
  RC_ASSERT(volume(surface) > 0.6 * shape.volume && volume(surface) < (1.0 + 1e-10) * shape.volume);
}

// Bounds from fine outlines: those of round pieces fall short of the curve by at most 1 - cos(pi / 64) of the radius,
// which is at most 1 m, on either angle.
template <int Dim>
Box<Dim> bounds_of_surface(const Shape<Dim>& shape, const Pose<Dim>& pose) {
  std::vector<Loop<Dim>> surface;
  if constexpr (Dim == 2)
    surface = outlines(shape, 64);
  else
    surface = faces(shape, 64);
  Box<Dim> bounds;
  for (const Loop<Dim>& loop : surface)
    for (const Vec<Dim>& corner : loop) bounds.extend(pose * corner);
  return bounds;
}

template <int Dim>
void bounds_touch_the_surface_on_every_side() {
  std::vector<Piece<Dim>> pieces = {test::random_piece<Dim>(), test::random_piece<Dim>()};
  const Shape<Dim> shape = make_shape<Dim>("any", std::move(pieces), {});
  const Pose<Dim> pose = test::random_pose<Dim>();
  const Box<Dim> claimed = bounds_at(shape, pose);
  const Box<Dim> seen = bounds_of_surface(shape, pose);
  RC_ASSERT((seen.min() - claimed.min()).minCoeff() > -1e-10);
  RC_ASSERT((claimed.max() - seen.max()).minCoeff() > -1e-10);
  RC_ASSERT((seen.min() - claimed.min()).maxCoeff() < 3e-3);
  RC_ASSERT((claimed.max() - seen.max()).maxCoeff() < 3e-3);
}

RC_GTEST_PROP(Bounds, TouchTheSurfaceOnEverySideInThePlane, ()) { bounds_touch_the_surface_on_every_side<2>(); }
RC_GTEST_PROP(Bounds, TouchTheSurfaceOnEverySideInSpace, ()) { bounds_touch_the_surface_on_every_side<3>(); }

}  // namespace
}  // namespace talus::shape_surface_test

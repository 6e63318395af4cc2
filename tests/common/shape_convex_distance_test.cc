#include <gtest/gtest.h>

#include <numbers>

#include "common/math/random.h"
#include "common/shape/convex_distance.h"

namespace talus::shape_convex_distance_test {
namespace {

constexpr double exact = 1e-9;  // [m]; coordinates near 1 with some hundred roundings of 1e-16 each

template <int Dim>
double distance(const Piece<Dim>& a, const Piece<Dim>& b, const Pose<Dim>& at_b = {}) {
  const ConvexPiece<Dim> one = convex_piece<Dim>(a);
  const ConvexPiece<Dim> other = moved(convex_piece<Dim>(b), at_b);
  const double there = signed_distance(one, other);
  const double back = signed_distance(other, one);
  EXPECT_NEAR(there, back, exact) << "must not depend on the order";
  return there;
}

Pose<3> at(double x, double y, double z) { return {Vec3(x, y, z)}; }
Pose<2> at(double x, double z) { return {Vec2(x, z)}; }

template <int Dim>
HullPiece<Dim> ball_of(double radius) {
  return {{Vec<Dim>::Zero()}, radius};
}

BoxPiece<3> random_box(std::mt19937_64& random) {
  BoxPiece<3> box;
  box.half = Vec3(0.5, 0.3, 0.2) + uniform_within<3>(Vec3::Constant(0.15), random);
  box.pose.position = uniform_within<3>(Vec3::Constant(0.5), random);
  box.pose.rotation = uniform_rotation<3>(random);
  return box;
}

/// Depth of overlap by the separating axis test, which is exact for boxes: the largest gap over face normals and
/// products of edges.
double depth_by_axes(const BoxPiece<3>& a, const BoxPiece<3>& b) {
  const Eigen::Matrix3d axes_a = a.pose.rotation.toRotationMatrix();
  const Eigen::Matrix3d axes_b = b.pose.rotation.toRotationMatrix();
  double widest = -1e9;
  const auto test = [&](const Vec3& direction) {
    if (direction.norm() < 1e-9) return;
    const Vec3 n = direction.normalized();
    const double reach =
        (axes_a.transpose() * n).cwiseAbs().dot(a.half) + (axes_b.transpose() * n).cwiseAbs().dot(b.half);
    widest = std::max(widest, std::abs(n.dot(b.pose.position - a.pose.position)) - reach);
  };
  for (int i = 0; i < 3; ++i) {
    test(axes_a.col(i));
    test(axes_b.col(i));
    for (int j = 0; j < 3; ++j) test(axes_a.col(i).cross(axes_b.col(j)));
  }
  return widest;
}

Vec3 nearest_in_box(const BoxPiece<3>& box, const Vec3& point) {
  const Vec3 local = box.pose.rotation.inverse() * (point - box.pose.position);
  return box.pose * Vec3(local.cwiseMax(-box.half).cwiseMin(box.half));
}

/// Distance of boxes that are apart: projecting a point from one to the other and back converges to it from above.
double distance_by_projection(const BoxPiece<3>& a, const BoxPiece<3>& b) {
  Vec3 p = a.pose.position;
  double gap = 0.0;
  for (int turn = 0; turn < 20000; ++turn) {
    const Vec3 q = nearest_in_box(b, p);
    const Vec3 next = nearest_in_box(a, q);
    gap = (next - q).norm();
    if ((next - p).norm() < 1e-13) break;
    p = next;
  }
  return gap;
}

TEST(ConvexDistance, OfBallsIsThatOfCentresLessRadii) {
  EXPECT_NEAR(distance<3>(ball_of<3>(0.5), ball_of<3>(0.25), at(0.0, 3.0, 4.0)), 4.25, exact);
  EXPECT_NEAR(distance<3>(ball_of<3>(0.5), ball_of<3>(0.25), at(0.0, 0.0, 0.25)), -0.5, exact);
  EXPECT_NEAR(distance<2>(ball_of<2>(0.5), ball_of<2>(0.5), at(0.6, 0.8)), 0.0, exact);
  EXPECT_NEAR(distance<2>(ball_of<2>(0.5), ball_of<2>(0.5)), -1.0, exact);
}

TEST(ConvexDistance, OfBallAndBoxFollowsFaceEdgeAndCorner) {
  const BoxPiece<3> box{.pose = {}, .half = Vec3(1.0, 0.5, 0.25)};
  const HullPiece<3> ball = ball_of<3>(0.1);
  EXPECT_NEAR(distance<3>(box, ball, at(1.5, 0.2, 0.1)), 0.4, exact);
  EXPECT_NEAR(distance<3>(box, ball, at(1.3, 0.9, 0.1)), 0.4, exact);
  EXPECT_NEAR(distance<3>(box, ball, at(1.2, 0.7, 0.35)), 0.3 - 0.1, exact);
  EXPECT_NEAR(distance<3>(box, ball, at(0.3, 0.1, 0.1)), -0.15 - 0.1, exact) << "centre inside, nearest face at z";
  EXPECT_NEAR(distance<3>(box, ball), -0.25 - 0.1, exact) << "centre in the middle";
  EXPECT_NEAR(distance<3>(box, ball, at(0.0, 0.0, 0.25)), -0.1, exact) << "centre on a face";
  EXPECT_NEAR(distance<3>(box, ball, at(1.0, 0.5, 0.25)), -0.1, exact) << "centre on a corner";
  const BoxPiece<2> rectangle{.pose = {}, .half = Vec2(1.0, 0.5)};
  const HullPiece<2> disc = ball_of<2>(0.1);
  EXPECT_NEAR(distance<2>(rectangle, disc, at(1.3, 0.9)), 0.4, exact);
  EXPECT_NEAR(distance<2>(rectangle, disc, at(0.9, 0.1)), -0.1 - 0.1, exact);
}

TEST(ConvexDistance, OfCapsulesIsThatOfTheirSegmentsLessRadii) {
  const HullPiece<3> lying{{Vec3(-1, 0, 0), Vec3(1, 0, 0)}, 0.2};
  const HullPiece<3> across{{Vec3(0, -1, 0), Vec3(0, 1, 0)}, 0.1};
  EXPECT_NEAR(distance<3>(lying, across, at(0.5, 0.3, 1.0)), 0.7, exact);
  EXPECT_NEAR(distance<3>(lying, across), -0.3, exact) << "axes that cross";
  EXPECT_NEAR(distance<3>(lying, lying, at(0.5, 0.3, 0.0)), -0.1, exact) << "parallel axes";
  EXPECT_NEAR(distance<3>(lying, lying, at(2.3, 0.4, 0.0)), 0.1, exact) << "tip to tip";
  EXPECT_NEAR(distance<3>(lying, lying, at(0.5, 0.0, 0.0)), -0.4, exact) << "axes in one line, overlapping";
  const HullPiece<2> flat{{Vec2(-1, 0), Vec2(1, 0)}, 0.2};
  const HullPiece<2> upright{{Vec2(0, -0.25), Vec2(0, 0.25)}, 0.1};
  EXPECT_NEAR(distance<2>(flat, upright, at(0.5, 1.0)), 0.75 - 0.3, exact);
  EXPECT_NEAR(distance<2>(flat, upright, at(0.5, 0.1)), -0.15 - 0.3, exact)
      << "in a plane, crossing axes must be parted";
  EXPECT_NEAR(distance<2>(flat, flat), -0.4, exact) << "the same segment twice";
}

TEST(ConvexDistance, OfCapsuleAndBoxKnowsPointsInsideAndOutside) {
  const BoxPiece<3> box{.pose = {}, .half = Vec3(1.0, 1.0, 0.5)};
  const HullPiece<3> upright{{Vec3(0, 0, -0.1), Vec3(0, 0, 2.0)}, 0.2};
  EXPECT_NEAR(distance<3>(box, upright, at(0.3, 0.2, 0.8)), 0.0, exact) << "tip touches the top";
  EXPECT_NEAR(distance<3>(box, upright, at(0.3, 0.2, 0.5)), -0.1 - 0.2, exact) << "out upwards";
  EXPECT_NEAR(distance<3>(box, upright, at(0.9, 0.0, -0.5)), -0.1 - 0.2, exact) << "out sideways";
}

TEST(ConvexDistance, OfHullsMeetsTipsAndTheInscribedPlane) {
  const HullPiece<3> octahedron{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  EXPECT_NEAR(distance<3>(octahedron, octahedron, at(0, 0, 2.5)), 0.5, exact);
  EXPECT_NEAR(distance<3>(octahedron, octahedron, at(0, 0, 2.0)), 0.0, exact);
  EXPECT_NEAR(distance<3>(octahedron, octahedron), -2.0 / std::numbers::sqrt3, exact) << "out through a face";
  EXPECT_NEAR(distance<3>(octahedron, octahedron, at(1, 1, 1)), 1.0 / std::numbers::sqrt3, exact) << "face to face";
  const HullPiece<2> triangle{{{0, 0}, {2, 0}, {0, 2}}};
  EXPECT_NEAR(distance<2>(triangle, triangle, at(2, 2)), std::numbers::sqrt2, exact);
  EXPECT_NEAR(distance<2>(triangle, triangle, at(0.5, 0.5)), -std::numbers::sqrt2 / 2, exact);
}

TEST(ConvexDistance, OfFlushStackedBoxesIsTheirGapOrOverlap) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 500; ++trial) {
    BoxPiece<3> lower = random_box(random);
    BoxPiece<3> upper = lower;
    const double gap = trial % 3 == 0 ? 0.0 : 1e-3 * uniform_both_sides(random);
    const double shift = trial % 2 == 0 ? 0.0 : 0.1 * uniform_both_sides(random);
    if (trial % 5 == 0) lower.pose.rotation = upper.pose.rotation = identity_rotation<3>();
    upper.pose.position = lower.pose * Vec3(shift, 0.0, 2.0 * lower.half.z() + gap);
    ASSERT_NEAR(distance<3>(lower, upper), gap, exact) << "trial " << trial;
  }
}

TEST(ConvexDistance, OfAnyTwoBoxesAgreesWithSeparatingAxesInsideAndProjectionOutside) {
  std::mt19937_64 random(3);
  int overlapping = 0;
  int apart = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const BoxPiece<3> a = random_box(random);
    BoxPiece<3> b = random_box(random);
    if (trial % 2 == 0) b.pose.position += uniform_within<3>(Vec3::Constant(1.5), random);
    const double by_axes = depth_by_axes(a, b);
    const double found = distance<3>(a, b);
    if (by_axes < 0.0) {
      ++overlapping;
      ASSERT_NEAR(found, by_axes, exact) << "trial " << trial;
    } else {
      ++apart;
      ASSERT_NEAR(found, distance_by_projection(a, b), 1e-6) << "trial " << trial;  // as far as projection converges
      ASSERT_GE(found, by_axes - exact) << "trial " << trial;
    }
  }
  EXPECT_GT(overlapping, 200);
  EXPECT_GT(apart, 200);
}

TEST(ConvexDistance, OfRandomPolygonsIsTheLeastShiftThatPartsThem) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 500; ++trial) {
    const auto polygon = [&] {
      HullPiece<2> hull;
      const double phase = uniform(random);
      const double size = 0.3 + 0.5 * uniform(random);
      for (int k = 0; k < 7; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k + phase) / 7.0;
        hull.corners.emplace_back(size * std::cos(angle), size * std::sin(angle));
      }
      return hull;
    };
    const HullPiece<2> a = polygon();
    const HullPiece<2> b = polygon();
    const Vec2 offset = uniform_within<2>(Vec2::Constant(0.5), random);
    const double found = distance<2>(a, b, {offset});
    double by_direction = -1e9;  // the largest gap over directions: exact inside, a lower bound outside
    for (int k = 0; k < 3600; ++k) {
      const Vec2 n(std::cos(k * std::numbers::pi / 1800), std::sin(k * std::numbers::pi / 1800));
      double gap = n.dot(offset);
      double reach_a = -1e9;
      double reach_b = -1e9;
      for (const Vec2& corner : a.corners) reach_a = std::max(reach_a, n.dot(corner));
      for (const Vec2& corner : b.corners) reach_b = std::max(reach_b, -n.dot(corner));
      gap -= reach_a + reach_b;
      by_direction = std::max(by_direction, gap);
    }
    // Directions 0.1 degree apart miss the best by up to its cosine's rest and lean: 1e-3 of the size.
    ASSERT_NEAR(found, by_direction, 2e-3) << "trial " << trial;
    ASSERT_GE(found, by_direction - exact) << "trial " << trial;
  }
}

TEST(ConvexDistance, IsExactFarFromTheOriginToo) {
  const BoxPiece<3> box{.pose = {}, .half = Vec3(0.5, 0.5, 0.5)};
  const Pose<3> here{Vec3(1e4, -1e4, 1e4), Rotation<3>(Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()))};
  const Pose<3> there{here * Vec3(0.2, 0.1, 0.99), here.rotation};
  // Places near 1e4 are rounded to 2e-12.
  EXPECT_NEAR(signed_distance(moved(convex_piece<3>(box), here), moved(convex_piece<3>(box), there)), -0.01, 1e-8);
}

}  // namespace
}  // namespace talus::shape_convex_distance_test

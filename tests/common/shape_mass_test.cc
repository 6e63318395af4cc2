// Volume, centre and inertia against closed forms worked out by hand.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "common/shape/catalogue.h"
#include "tests/common/shape_generators.h"

namespace talus::shape_mass_test {
namespace {

using std::numbers::pi;

constexpr double rounding = 1e-12;  // relative; nothing but rounding is lost, the integrals are exact
constexpr Material unit_density = {.density = 1.0};

void expect_diagonal(const Inertia<3>& inertia, double x, double y, double z) {
  EXPECT_LT((inertia - Inertia<3>(Vec3(x, y, z).asDiagonal())).norm(), rounding * inertia.norm()) << inertia;
}

TEST(BoxShape, HasMassTimesSquaredSidesOverTwelve) {
  const Shape<2> flat = make_shape("box", box_pieces<2>({3.0, 2.0}), {.density = 10.0});
  EXPECT_DOUBLE_EQ(flat.mass, 60.0);
  EXPECT_NEAR(flat.inertia(0, 0), 60.0 * (9.0 + 4.0) / 12.0, rounding * 100.0);
  const Shape<3> solid = make_shape("box", box_pieces<3>({3.0, 2.0, 1.0}), {.density = 2.0});
  EXPECT_DOUBLE_EQ(solid.mass, 12.0);
  expect_diagonal(solid.inertia, 12.0 * (4.0 + 1.0) / 12.0, 12.0 * (9.0 + 1.0) / 12.0, 12.0 * (9.0 + 4.0) / 12.0);
}

TEST(BallShape, IsADiscOrASphere) {
  const Shape<2> disc = make_shape("disc", ball_pieces<2>(2.0), unit_density);
  EXPECT_NEAR(disc.volume, 4.0 * pi, rounding * 10.0);
  EXPECT_NEAR(disc.inertia(0, 0), 4.0 * pi * 4.0 / 2.0, rounding * 100.0);
  const Shape<3> sphere = make_shape("sphere", ball_pieces<3>(2.0), unit_density);
  EXPECT_NEAR(sphere.volume, 32.0 / 3.0 * pi, rounding * 100.0);
  const double moment = 0.4 * sphere.volume * 4.0;
  expect_diagonal(sphere.inertia, moment, moment, moment);
}

// Half a disc has its centre 4 r / (3 pi) from the flat side, and about it the inertia m r^2 / 2 less what the
// parallel-axis theorem adds for that distance.
TEST(CapsuleShape, IsARectangleBetweenHalfDiscsInThePlane) {
  const double r = 0.5;
  const double straight = 3.0;
  const Shape<2> capsule = make_shape("capsule", capsule_pieces<2>(straight + 2.0 * r, r), unit_density);
  const double rectangle = straight * 2.0 * r;
  const double half_disc = pi * r * r / 2.0;
  const double offset = 4.0 * r / (3.0 * pi);
  const double about_own_centre = half_disc * (r * r / 2.0 - offset * offset);
  const double reach = straight / 2.0 + offset;
  const double expected =
      rectangle * (straight * straight + 4.0 * r * r) / 12.0 + 2.0 * (about_own_centre + half_disc * reach * reach);
  EXPECT_NEAR(capsule.volume, rectangle + 2.0 * half_disc, rounding * 10.0);
  EXPECT_NEAR(capsule.inertia(0, 0), expected, rounding * 10.0);
}

// Half a ball has its centre 3 r / 8 from the flat side; across its axis and about that side's middle 2/5 m r^2.
TEST(CapsuleShape, IsACylinderBetweenHalfBallsInSpace) {
  const double r = 0.5;
  const double straight = 3.0;
  const Shape<3> capsule = make_shape("capsule", capsule_pieces<3>(straight + 2.0 * r, r), unit_density);
  const double cylinder = straight * pi * r * r;
  const double half_ball = 2.0 / 3.0 * pi * r * r * r;
  const double offset = 3.0 * r / 8.0;
  const double reach = straight / 2.0 + offset;
  const double along = cylinder * r * r / 2.0 + 2.0 * half_ball * 0.4 * r * r;
  const double across = cylinder * (3.0 * r * r + straight * straight) / 12.0 +
                        2.0 * half_ball * (0.4 * r * r - offset * offset + reach * reach);
  EXPECT_NEAR(capsule.volume, cylinder + 2.0 * half_ball, rounding * 10.0);
  expect_diagonal(capsule.inertia, along, across, across);
}

// The base is a regular polygon of n sides in a circle of radius r: area n r^2 / 2 sin(2 pi / n), and about the axis
// the mean of the squared distance is r^2 (2 + cos(2 pi / n)) / 6.
TEST(CylinderShape, IsAPrismOverARegularPolygonInSpace) {
  const double r = 0.5;
  const double length = 2.0;
  const int sides = 16;
  const Shape<3> cylinder = make_shape("c", cylinder_pieces<3>({length, r, sides}), unit_density);
  const double turn = 2.0 * pi / sides;
  const double volume = length * sides * r * r / 2.0 * std::sin(turn);
  const double along = volume * r * r * (2.0 + std::cos(turn)) / 6.0;
  const double across = along / 2.0 + volume * length * length / 12.0;
  EXPECT_NEAR(cylinder.volume, volume, rounding * 10.0);
  expect_diagonal(cylinder.inertia, across, across, along);
  EXPECT_NEAR(1.0 - volume / (length * pi * r * r), 0.026, 5e-4) << "as docs/scenes.md states";
}

TEST(CylinderShape, IsARectangleInThePlane) {
  const Shape<2> cylinder = make_shape("c", cylinder_pieces<2>({2.0, 0.5, 16}), unit_density);
  EXPECT_NEAR(cylinder.volume, 2.0, rounding);
  EXPECT_NEAR(cylinder.bounds.sizes().x(), 1.0, rounding);
}

TEST(CylinderShape, IsRefusedOutsideOfItsRanges) {
  EXPECT_THROW(cylinder_pieces<3>({2.0, 0.5, 2}), std::invalid_argument);
  EXPECT_THROW(cylinder_pieces<3>({-2.0, 0.5, 16}), std::invalid_argument);
  EXPECT_THROW(cylinder_pieces<2>({2.0, 0.0, 16}), std::invalid_argument);
}

// A triangle's inertia about its centre is m (a^2 + b^2 + c^2) / 36.
TEST(PolygonShape, OfThreeCornersIsATriangle) {
  const std::vector<Vec2> corners = {{1.0, 1.0}, {4.0, 1.0}, {1.0, 5.0}};
  const Shape<2> triangle = make_shape("triangle", hull_pieces<2>(corners), unit_density);
  EXPECT_NEAR(triangle.volume, 6.0, rounding * 10.0);
  EXPECT_NEAR(triangle.inertia(0, 0), 6.0 * (9.0 + 16.0 + 25.0) / 36.0, rounding * 10.0);
  EXPECT_LT((triangle.reference - Vec2(-2.0, -7.0 / 3.0)).norm(), rounding * 10.0);
}

// With its right corner in the origin and legs a, b, c the integral of x^2 is a^3 b c / 60, of x it is a^2 b c / 24,
// and of x y it is a^2 b^2 c / 120.
TEST(HullShape, OfFourCornersIsATetrahedron) {
  const Vec3 legs(1.0, 2.0, 3.0);
  const std::vector<Vec3> corners = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 0.0, 3.0}};
  const Shape<3> tetrahedron = make_shape("tetrahedron", hull_pieces<3>(corners), unit_density);
  EXPECT_NEAR(tetrahedron.volume, 1.0, rounding);
  EXPECT_LT((tetrahedron.reference + legs / 4.0).norm(), rounding);
  const Eigen::Matrix3d squares = (legs * legs.transpose()).cwiseProduct(Eigen::Matrix3d::Ones() / 20.0) +
                                  Eigen::Matrix3d(legs.cwiseAbs2().asDiagonal()) / 20.0 -
                                  legs * legs.transpose() / 16.0;
  const Inertia<3> expected = squares.trace() * Inertia<3>::Identity() - squares;
  EXPECT_LT((tetrahedron.inertia - expected).norm(), rounding * 10.0) << tetrahedron.inertia;
}

TEST(HullShape, OfABoxesCornersEqualsTheBox) {
  std::vector<Vec3> corners = {{0.5, 1.0, 1.5}};  // a point inside changes nothing
  for (int i = 0; i < 8; ++i)
    corners.push_back({(i & 1) != 0 ? 1.0 : 0.0, (i & 2) != 0 ? 2.0 : 0.0, (i & 4) != 0 ? 3.0 : 0.0});
  const Shape<3> hull = make_shape("hull", hull_pieces<3>(corners), {});
  const Shape<3> box = make_shape("box", box_pieces<3>({1.0, 2.0, 3.0}), {});
  EXPECT_EQ(std::get<HullPiece<3>>(hull.pieces[0]).corners.size(), 8u);
  EXPECT_NEAR(hull.mass, box.mass, rounding * box.mass);
  EXPECT_LT((hull.inertia - box.inertia).norm(), rounding * box.inertia.norm());
  EXPECT_TRUE(hull.bounds.isApprox(box.bounds));
}

TEST(LShape, HasTheInertiaOfTheParallelAxisTheorem) {
  const Shape<2> shape = make_shape("l", l_pieces<2>({}), unit_density);
  const Vec2 centre = (0.4 * Vec2(0.5, 0.2) + 0.24 * Vec2(0.2, 0.7)) / 0.64;
  const double lying = 0.4 * (1.0 + 0.16) / 12.0 + 0.4 * (Vec2(0.5, 0.2) - centre).squaredNorm();
  const double standing = 0.24 * (0.16 + 0.36) / 12.0 + 0.24 * (Vec2(0.2, 0.7) - centre).squaredNorm();
  EXPECT_NEAR(shape.volume, 0.64, rounding);  // not 0.82, its convex hull's
  EXPECT_NEAR(shape.bounding_volume, 1.0, rounding);
  EXPECT_NEAR(shape.extent, std::sqrt(2.0), rounding);
  EXPECT_NEAR(shape.inertia(0, 0), lying + standing, rounding);
  EXPECT_LT((shape.reference + centre).norm(), rounding);
}

TEST(LShape, InSpaceIsTheFlatOneDrawnOutAlongY) {
  const Shape<2> flat = make_shape("l", l_pieces<2>({}), unit_density);
  const Shape<3> solid = make_shape("l", l_pieces<3>({.depth = 0.5}), unit_density);
  EXPECT_NEAR(solid.volume, 0.5 * flat.volume, rounding);
  EXPECT_NEAR(solid.inertia(1, 1), 0.5 * flat.inertia(0, 0), rounding);  // about y no depth counts
  EXPECT_LT((solid.reference - Vec3(flat.reference.x(), 0.0, flat.reference.y())).norm(), rounding);
  EXPECT_NEAR(solid.bounds.sizes().y(), 0.5, rounding);
}

template <int Dim>
void masses_do_not_depend_on_the_axes_of_description() {
  const Piece<Dim> piece = test::random_piece<Dim>();
  const Pose<Dim> pose = test::random_pose<Dim>();
  const MassProperties<Dim> here = mass_properties(piece);
  const MassProperties<Dim> there = mass_properties(test::placed(piece, pose));
  const Eigen::Matrix<double, Dim, Dim> turn = pose.rotation.toRotationMatrix();
  Inertia<Dim> turned = here.inertia;
  if constexpr (Dim == 3) turned = turn * here.inertia * turn.transpose();
  // Up to 15 m off the origin and a least volume of 0.004 m^3: squares of the distance cancel to 1e-10 of the inertia.
  RC_ASSERT(std::abs(there.volume - here.volume) < 1e-10 * here.volume);
  RC_ASSERT((there.centre - pose * here.centre).norm() < 1e-10);
  RC_ASSERT((there.inertia - turned).norm() < 1e-10 * here.inertia.norm());
}

RC_GTEST_PROP(Masses, DoNotDependOnTheAxesOfDescriptionInThePlane, ()) {
  masses_do_not_depend_on_the_axes_of_description<2>();
}
RC_GTEST_PROP(Masses, DoNotDependOnTheAxesOfDescriptionInSpace, ()) {
  masses_do_not_depend_on_the_axes_of_description<3>();
}

template <int Dim>
void two_halves_make_the_whole() {
  const Vec<Dim> half = Vec<Dim>::Constant(1.2) + test::random_point<Dim>(1.0);
  const Pose<Dim> pose = test::random_pose<Dim>();
  const double cut = test::random_number(0.1, 0.9);
  Vec<Dim> low_half = half;
  Vec<Dim> high_half = half;
  low_half[0] *= cut;
  high_half[0] *= 1.0 - cut;
  const Vec<Dim> low = pose * Vec<Dim>(Vec<Dim>::Unit(0) * (low_half[0] - half[0]));
  const Vec<Dim> high = pose * Vec<Dim>(Vec<Dim>::Unit(0) * (half[0] - high_half[0]));
  const auto parts = make_shape<Dim>(
      "parts", {BoxPiece<Dim>{{low, pose.rotation}, low_half}, BoxPiece<Dim>{{high, pose.rotation}, high_half}}, {});
  const auto whole = make_shape<Dim>("whole", {BoxPiece<Dim>{pose, half}}, {});
  RC_ASSERT(std::abs(parts.mass - whole.mass) < 1e-10 * whole.mass);
  RC_ASSERT((parts.inertia - whole.inertia).norm() < 1e-10 * whole.inertia.norm());
  RC_ASSERT((parts.reference - whole.reference).norm() < 1e-10);
}

RC_GTEST_PROP(Masses, OfTwoHalvesMakeTheWholeInThePlane, ()) { two_halves_make_the_whole<2>(); }
RC_GTEST_PROP(Masses, OfTwoHalvesMakeTheWholeInSpace, ()) { two_halves_make_the_whole<3>(); }

}  // namespace
}  // namespace talus::shape_mass_test

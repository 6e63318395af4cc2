// Geometry of the stacking structure (section 3.1), against closed forms.

#include "common/pile/pile.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "common/math/angle.h"
#include "common/pile/profile.h"

namespace talus::pile_test {
namespace {

constexpr TypicalBody body{.bounding_volume = 0.4, .extent = 1.4, .mass = 1.0};

/// Slope of 5 to 80 degrees and room for 1 to 100,000 bodies.
double any_alpha() { return in_radians(*rc::gen::inRange(50, 800) / 10.0); }
double any_size() { return *rc::gen::inRange(10, 1000000) / 10.0; }

template <int Dim>
double capacities(const Pile<Dim>& pile) {
  double sum = 0.0;
  for (const Layer& layer : pile.layers) sum += layer.capacity;
  return sum;
}

template <int Dim>
void expect_sound_structure() {
  const double alpha = any_alpha();
  const double size = any_size();
  const Pile<Dim> pile = make_pile<Dim>(Vec<Dim>::Zero(), alpha, size, body);
  RC_ASSERT(!pile.layers.empty());
  RC_ASSERT(std::abs(capacities(pile) / size - 1.0) < 1e-9);  // rounding of a sum of at most 100 layers
  RC_ASSERT(std::abs(pile.height - pile.radius * std::tan(alpha)) < 1e-9 * pile.height);
  if (pile.height >= body.extent) RC_ASSERT(pile.layers.front().top >= body.extent * (1.0 - 1e-12));
  for (std::size_t i = 1; i < pile.layers.size(); ++i) {
    RC_ASSERT(pile.layers[i].capacity < pile.layers[i - 1].capacity);
    RC_ASSERT(pile.layers[i].radius < pile.layers[i - 1].radius);
    RC_ASSERT(pile.layers[i].capacity > 0.0);
  }
}

TEST(ConeProfile, FollowsEquationOne) {
  const double alpha = in_radians(35.0);
  const double radius = Profile<3>::base_radius(50.0, alpha);
  EXPECT_NEAR(std::numbers::pi / 3.0 * std::pow(radius, 3) * std::tan(alpha), 50.0, 1e-12 * 50.0);
}

TEST(WedgeProfile, FollowsEquationOnesTwin) {
  const double alpha = in_radians(35.0);
  const double radius = Profile<2>::base_radius(50.0, alpha);
  EXPECT_NEAR(radius * radius * std::tan(alpha), 50.0, 1e-12 * 50.0);
}

TEST(PileLayer, HoldsTheVolumeOfItsFrustum) {
  const Pile<3> pile = make_pile<3>(Vec3::Zero(), in_radians(45.0), 1000.0, body);
  const Layer& layer = pile.layers[1];
  const double upper = pile.layers[2].radius;
  const double squares = layer.radius * layer.radius + layer.radius * upper + upper * upper;
  const double frustum = std::numbers::pi / 3.0 * (layer.top - layer.bottom) * squares;
  EXPECT_NEAR(layer.volume, frustum, 1e-12 * frustum);
}

TEST(Closeness, IsOneOnTheAxisAndZeroOutsideTheLayer) {
  const Pile<3> pile = make_pile<3>(Vec3(1.0, 2.0, 0.0), in_radians(45.0), 1000.0, body);
  const Layer& layer = pile.layers[0];
  EXPECT_DOUBLE_EQ(pile.closeness(Vec3(1.0, 2.0, 0.3), layer), 1.0);
  EXPECT_DOUBLE_EQ(pile.closeness(Vec3(1.0 + 0.25 * layer.radius, 2.0, 0.3), layer), 0.75);
  EXPECT_DOUBLE_EQ(pile.closeness(Vec3(1.0 + 2.0 * layer.radius, 2.0, 0.3), layer), 0.0);
}

RC_GTEST_PROP(PileStructure, HoldsJustItsBodiesIn2D, ()) { expect_sound_structure<2>(); }
RC_GTEST_PROP(PileStructure, HoldsJustItsBodiesIn3D, ()) { expect_sound_structure<3>(); }

TEST(PileStructure, HasAsManyLayersAsExtentsFitIntoItsHeight) {
  // alpha 45: h = r = cbrt(3 N v / pi); N v = 400 gives h = 7.256, and 7.256 / 1.4 = 5.18.
  const Pile<3> pile = make_pile<3>(Vec3::Zero(), in_radians(45.0), 1000.0, body);
  EXPECT_NEAR(pile.height, std::cbrt(3.0 * 400.0 / std::numbers::pi), 1e-12);
  EXPECT_EQ(pile.layers.size(), 5U);
}

TEST(PileStructure, KeepsOneLayerWhenLowerThanABody) {
  EXPECT_EQ(make_pile<3>(Vec3::Zero(), in_radians(45.0), 1.0, body).layers.size(), 1U);
}

TEST(PileLayer, OfAPointGoesByHeightThenRadius) {
  const Vec3 centre(10.0, -5.0, 2.0);
  const Pile<3> pile = make_pile<3>(centre, in_radians(45.0), 1000.0, body);
  const Layer& second = pile.layers[1];
  const double height = 0.5 * (second.bottom + second.top);
  EXPECT_EQ(pile.layer_of(centre + Vec3(0.0, 0.0, height)), 1);
  EXPECT_EQ(pile.layer_of(centre + Vec3(0.999 * second.radius, 0.0, height)), 1);
  EXPECT_EQ(pile.layer_of(centre + Vec3(0.0, 1.001 * second.radius, height)), -1);
  EXPECT_EQ(pile.layer_of(centre - Vec3(0.0, 0.0, 0.001)), -1);
}

TEST(PileLayer, AboveTheApexIsTheTopLayer) {
  const Pile<2> pile = make_pile<2>(Vec2::Zero(), in_radians(45.0), 1000.0, body);
  EXPECT_EQ(pile.layer_of(Vec2(0.0, 10.0 * pile.height)), static_cast<int>(pile.layers.size()) - 1);
}

/// Volume of all layers.
template <int Dim>
double volume(const Pile<Dim>& pile) {
  double sum = 0.0;
  for (const Layer& layer : pile.layers) sum += layer.volume;
  return sum;
}

TEST(WalledPile, IsAnOrdinaryConeUntilItTouchesAWall) {
  const auto walls = box_boundary<3>(Vec2(40.0, 60.0), 5.0);
  const Pile<3> inside = make_pile<3>(Vec3::Zero(), in_radians(45.0), 1000.0, body, walls);
  EXPECT_FALSE(inside.boundary.has_value());
  EXPECT_EQ(inside.radius, make_pile<3>(Vec3::Zero(), in_radians(45.0), 1000.0, body).radius);
}

TEST(WalledPile, RisesInItsContainerWithATipAboveIt) {
  // 4 m x 6 m, tip 2 m high at 45 degrees: 24 m^2 * 2 m / 3 = 16 m^3; 100 bodies of 0.4 m^3 leave 24 m^3 = 1 m of lift.
  const Pile<3> pile = make_pile<3>(Vec3::Zero(), in_radians(45.0), 100.0, body, box_boundary<3>(Vec2(4.0, 6.0), 5.0));
  EXPECT_NEAR(pile.lift, 1.0, 1e-12);
  EXPECT_NEAR(pile.height, 3.0, 1e-12);
  EXPECT_NEAR(volume(pile), 40.0, 1e-12 * 40.0);
}

TEST(WalledPile, WhoseLowestLayerTouchesTheWallsGrowsUpwardsOnly) {
  const auto walls = box_boundary<3>(Vec2(4.0, 6.0), 5.0);
  const Pile<3> before = make_pile<3>(Vec3::Zero(), in_radians(45.0), 100.0, body, walls);
  const Pile<3> after = make_pile<3>(Vec3::Zero(), in_radians(45.0), 160.0, body, walls);
  EXPECT_EQ(after.layers.front().radius, before.layers.front().radius);
  EXPECT_NEAR(after.lift - before.lift, 60.0 * 0.4 / 24.0, 1e-12);  // 60 bodies of 0.4 m^3 on 24 m^2
}

TEST(WalledPile, StopsAtTheRim) {
  const Pile<3> pile = make_pile<3>(Vec3::Zero(), in_radians(45.0), 1e6, body, box_boundary<3>(Vec2(4.0, 6.0), 5.0));
  EXPECT_DOUBLE_EQ(pile.lift, 5.0);
  EXPECT_NEAR(pile.structure_size, (24.0 * 5.0 + 16.0) / 0.4, 1e-9);
}

TEST(WalledPile, CountsOnlyWhatLiesWithinTheWalls) {
  const Pile<3> pile = make_pile<3>(Vec3::Zero(), in_radians(45.0), 1e6, body, box_boundary<3>(Vec2(4.0, 6.0), 5.0));
  EXPECT_EQ(pile.layer_of(Vec3(1.9, 2.9, 0.1)), 0) << "in a corner of the container";
  EXPECT_EQ(pile.layer_of(Vec3(2.1, 0.0, 0.1)), -1);
  EXPECT_EQ(pile.layer_of(Vec3(0.0, 3.1, 0.1)), -1);
}

TEST(Boundary, OfWallsHasThePolygonsArea) {
  Boundary<3> triangle{.walls = {{Vec2(0.0, -1.0), 1.0},
                                 {Vec2(std::sqrt(3.0) / 2.0, 0.5), 1.0},
                                 {Vec2(-std::sqrt(3.0) / 2.0, 0.5), 1.0}}};
  EXPECT_NEAR(triangle.area(), 3.0 * std::sqrt(3.0), 1e-6);  // around a circle of radius 1; clipped from 1e6 m
  triangle.walls.pop_back();
  EXPECT_THROW(triangle.area(), std::invalid_argument);
}

TEST(Boundary, OfAWedgeIsAnInterval) {
  const auto walls = box_boundary<2>(Horizontal<2>(6.0), 2.0);
  EXPECT_DOUBLE_EQ(walls.area(), 6.0);
  EXPECT_DOUBLE_EQ(walls.gauge(Horizontal<2>(-1.5)), 0.5);
}

}  // namespace
}  // namespace talus::pile_test

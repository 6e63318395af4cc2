// Geometry of the stacking structure (section 3.1), against closed forms.

#include "common/pile/pile.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "common/pile/profile.h"

namespace talus {
namespace {

constexpr TypicalBody body{.bounding_volume = 0.4, .extent = 1.4, .mass = 1.0};

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Slope of 5 to 80 degrees and room for 1 to 100,000 bodies.
double any_alpha() { return radians(*rc::gen::inRange(50, 800) / 10.0); }
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
  const double alpha = radians(35.0);
  const double radius = Profile<3>::base_radius(50.0, alpha);
  EXPECT_NEAR(std::numbers::pi / 3.0 * std::pow(radius, 3) * std::tan(alpha), 50.0, 1e-12 * 50.0);
}

TEST(WedgeProfile, FollowsEquationOnesTwin) {
  const double alpha = radians(35.0);
  const double radius = Profile<2>::base_radius(50.0, alpha);
  EXPECT_NEAR(radius * radius * std::tan(alpha), 50.0, 1e-12 * 50.0);
}

TEST(ConeProfile, SliceDownToAPointIsACone) {
  EXPECT_NEAR(Profile<3>::slice_volume(2.0, 0.0, 3.0), std::numbers::pi / 3.0 * 4.0 * 3.0, 1e-12);
}

RC_GTEST_PROP(PileStructure, HoldsJustItsBodiesIn2D, ()) { expect_sound_structure<2>(); }
RC_GTEST_PROP(PileStructure, HoldsJustItsBodiesIn3D, ()) { expect_sound_structure<3>(); }

TEST(PileStructure, HasAsManyLayersAsExtentsFitIntoItsHeight) {
  // alpha 45: h = r = cbrt(3 N v / pi); N v = 400 gives h = 7.256, and 7.256 / 1.4 = 5.18.
  const Pile<3> pile = make_pile<3>(Vec3::Zero(), radians(45.0), 1000.0, body);
  EXPECT_NEAR(pile.height, std::cbrt(3.0 * 400.0 / std::numbers::pi), 1e-12);
  EXPECT_EQ(pile.layers.size(), 5U);
}

TEST(PileStructure, KeepsOneLayerWhenLowerThanABody) {
  EXPECT_EQ(make_pile<3>(Vec3::Zero(), radians(45.0), 1.0, body).layers.size(), 1U);
}

TEST(PileLayer, OfAPointGoesByHeightThenRadius) {
  const Vec3 centre(10.0, -5.0, 2.0);
  const Pile<3> pile = make_pile<3>(centre, radians(45.0), 1000.0, body);
  const Layer& second = pile.layers[1];
  const double height = 0.5 * (second.bottom + second.top);
  EXPECT_EQ(pile.layer_of(centre + Vec3(0.0, 0.0, height)), 1);
  EXPECT_EQ(pile.layer_of(centre + Vec3(0.999 * second.radius, 0.0, height)), 1);
  EXPECT_EQ(pile.layer_of(centre + Vec3(0.0, 1.001 * second.radius, height)), -1);
  EXPECT_EQ(pile.layer_of(centre - Vec3(0.0, 0.0, 0.001)), -1);
}

TEST(PileLayer, AboveTheApexIsTheTopLayer) {
  const Pile<2> pile = make_pile<2>(Vec2::Zero(), radians(45.0), 1000.0, body);
  EXPECT_EQ(pile.layer_of(Vec2(0.0, 10.0 * pile.height)), static_cast<int>(pile.layers.size()) - 1);
}

}  // namespace
}  // namespace talus

// Gates and regions on bodies that are put where they are.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "common/measure/gate_counter.h"
#include "common/measure/region_meter.h"
#include "common/shape/catalogue.h"
#include "tests/common/still_world.h"

namespace talus::measure_instruments_test {
namespace {

constexpr double no_ground = -std::numeric_limits<double>::infinity();
constexpr double dt = 0.01;
constexpr double extent = 1.0;  // D [m]

template <int Dim>
WorldDescription<Dim> description() {
  WorldDescription<Dim> world;
  world.gravity = 1.0;  // with D = 1 m the unit of time is a second
  world.shapes.push_back(make_shape<Dim>("cube", box_pieces<Dim>(Vec<Dim>::Ones()), {}));
  world.shapes.push_back(make_shape<Dim>("ball", ball_pieces<Dim>(0.5), {}));
  world.shapes.push_back(make_shape<Dim>("capsule", capsule_pieces<Dim>(2.0, 0.4), {}));
  return world;
}

/// A gate of 4 m on the ground of a hopper; forward is down.
class Gate : public ::testing::Test {
 protected:
  Gate() { world_.step(); }

  static GateParams<2> outlet() {
    GateParams<2> gate;
    gate.corners = {{-2.0, 0.0}, {2.0, 0.0}};
    gate.jam_after = 10.0;
    return gate;
  }
  BodyIndex add(double x, double height) {
    BodyDef<2> body;
    body.shape = 1;
    body.pose.position = {x, height};
    return world_.add(body);
  }
  void move(BodyIndex body, double x, double height) {
    Pose<2> to;
    to.position = {x, height};
    world_.move(body, to);
  }
  void wait(double seconds) {
    for (int i = 0; i < std::lround(seconds / dt); ++i) gate_.update(world_, time_ += dt, dt);
  }

  StillWorld<2> world_{description<2>()};
  GateCounter<2> gate_{outlet(), 1.0};
  double time_ = 0.0;
};

TEST_F(Gate, CountsNoBodyThatTremblesInItAndNoneThatGoesAroundIt) {
  const BodyIndex trembles = add(0.0, 0.01);
  const BodyIndex around = add(3.0, 1.0);
  wait(dt);
  for (int i = 0; i < 10; ++i) {
    move(trembles, 0.0, i % 2 == 0 ? -0.03 : 0.03);
    wait(dt);
  }
  move(around, 3.0, -1.0);
  wait(dt);
  EXPECT_EQ(gate_.forward() + gate_.backward(), 0);
  EXPECT_FALSE(gate_.first());
  EXPECT_FALSE(gate_.rate());
  move(trembles, 0.0, -0.1);
  wait(dt);
  EXPECT_EQ(gate_.forward(), 1);
}

TEST_F(Gate, IsJammedSinceTheLastPassageWhileBodiesStandBeforeItUntilTheNextOne) {
  const BodyIndex first = add(0.0, 0.5);
  const BodyIndex second = add(0.5, 1.0);
  wait(30.0);
  EXPECT_TRUE(gate_.jams().empty()) << "nothing has passed yet, so it is not known where bodies come from";
  move(first, 0.0, -0.5);
  wait(9.0);
  EXPECT_FALSE(gate_.jammed());
  wait(3.0);
  ASSERT_TRUE(gate_.jammed());
  EXPECT_NEAR(gate_.jams()[0].from, 30.0, dt) << "the step of the passage ends a step later";
  move(second, 0.5, -0.5);
  wait(30.0);
  ASSERT_EQ(gate_.jams().size(), 1U) << "an empty hopper is not jammed";
  EXPECT_NEAR(gate_.jams()[0].to.value(), 42.0, dt);
  EXPECT_NEAR(gate_.rate().value(), 1.0 / 12.0, 1e-4) << "the first passage begins the time";
}

TEST_F(Gate, IsJammedOnceAllBodiesSleepWithOneBeforeIt) {
  const BodyIndex first = add(0.0, 0.5);
  const BodyIndex second = add(0.5, 1.0);
  wait(dt);
  move(first, 0.0, -0.5);
  wait(2.0);
  EXPECT_FALSE(gate_.jammed());
  world_.freeze(std::vector<BodyIndex>{first, second});
  wait(1.1);
  EXPECT_TRUE(gate_.jammed());
}

TEST_F(Gate, IsNotJammedByBodiesThatLieBesideTheOpening) {
  const BodyIndex first = add(0.0, 0.5);
  add(2.3, 0.5);
  add(-2.3, 0.5);
  wait(dt);
  move(first, 0.0, -0.5);
  wait(30.0);
  EXPECT_TRUE(gate_.jams().empty());
}

template <int Dim>
RegionParams<Dim> box(double low, double high) {
  return {.name = "box", .box = {Vec<Dim>::Constant(low), Vec<Dim>::Constant(high)}};
}

template <int Dim>
void expect_grid_of_cubes_has_its_packing() {
  StillWorld<Dim> world(description<Dim>());
  constexpr int side = 4;
  constexpr double spacing = 1.25;
  int bodies = 1;
  for (int axis = 0; axis < Dim; ++axis) bodies *= side;
  for (int i = 0; i < bodies; ++i) {
    BodyDef<Dim> body;
    for (int axis = 0, rest = i; axis < Dim; ++axis, rest /= side)
      body.pose.position[axis] = spacing * (rest % side + 0.5);
    world.add(body);
  }
  const RegionReading whole = RegionMeter<Dim>(box<Dim>(0.0, side * spacing), extent).read(world, no_ground);
  EXPECT_EQ(whole.bodies, bodies);
  EXPECT_NEAR(whole.packing.value(), std::pow(1.0 / spacing, Dim), 1e-12);
  // From the middle of the first cubes to that of the last: halves, quarters and eighths of the outer ones.
  const RegionReading cut = RegionMeter<Dim>(box<Dim>(0.5 * spacing, 3.5 * spacing), extent).read(world, no_ground);
  EXPECT_NEAR(cut.solid_volume, std::pow(3.0, Dim), 1e-12);
  EXPECT_NEAR(cut.packing.value(), std::pow(3.0 / (3.0 * spacing), Dim), 1e-12);
}

TEST(Region, OfCubesInAGridHasItsPackingFractionExactly) {
  expect_grid_of_cubes_has_its_packing<2>();
  expect_grid_of_cubes_has_its_packing<3>();
}

/// Of a cube between walls that reach half a metre into a region of 64 m^3 and below the ground.
RegionReading reading_between(const std::vector<Vec3>& walls, double ground) {
  WorldDescription<3> description_of_walls = description<3>();
  for (const Vec3& at : walls)
    description_of_walls.obstacles.push_back({make_shape<3>("wall", box_pieces<3>({2.0, 8.0, 8.0}), {}), {at}});
  StillWorld<3> world(description_of_walls);
  BodyDef<3> cube;
  cube.pose.position = {0.0, 0.0, 1.0};
  world.add(cube);
  return RegionMeter<3>(box<3>(-2.0, 2.0), extent).read(world, ground);
}

TEST(Region, CountsOnlyWhatObstaclesAndTheGroundLeaveFree) {
  const Vec3 left(-2.5, 0.0, 3.0);
  const Vec3 right(2.5, 0.0, 3.5);
  EXPECT_NEAR(reading_between({left, right}, 0.0).packing.value(), 1.0 / (3.0 * 4.0 * 2.0), 1e-12);
  EXPECT_NEAR(reading_between({left, left}, 0.0).packing.value(), 1.0 / (3.5 * 4.0 * 2.0), 1e-12) << "one in the other";
  EXPECT_FALSE(reading_between({}, 3.0).packing);
  EXPECT_FALSE(reading_between({}, 3.0).packing_reason.empty());
}

TEST(Region, HasThePartsOfBodiesThatItsBorderCuts) {
  const double ball = 4.0 / 3.0 * std::numbers::pi * 0.125;
  StillWorld<3> world(description<3>());
  BodyDef<3> body;
  body.shape = 1;
  world.add(body);
  const auto solid = [&](const RegionParams<3>& region) {
    return RegionMeter<3>(region, extent).read(world, no_ground).solid_volume;
  };
  EXPECT_DOUBLE_EQ(solid(box<3>(-1.0, 1.0)), ball);
  EXPECT_DOUBLE_EQ(solid({.name = "", .centre = Vec3::Zero(), .radius = 0.6}), ball);
  EXPECT_DOUBLE_EQ(solid({.name = "", .layer = {-1.0, 1.0}}), ball);
  EXPECT_DOUBLE_EQ(solid({.name = "", .centre = Vec3(2.0, 0.0, 0.0), .radius = 1.4}), 0.0);
  // Sums over 16 x 16 columns: the circle's edge cuts columns.
  EXPECT_NEAR(solid({.name = "", .layer = {0.0, 1.0}}), 0.5 * ball, 0.01 * ball);
  EXPECT_NEAR(solid({.name = "", .box = {Vec3(0.0, -1.0, -1.0), Vec3::Ones()}}), 0.5 * ball, 0.01 * ball);
  EXPECT_NEAR(solid({.name = "", .centre = Vec3::Zero(), .radius = 0.25}), ball / 8.0, 0.01 * ball);
}

TEST(Region, HasThePartsOfTurnedBodies) {
  StillWorld<2> world(description<2>());
  BodyDef<2> turned;  // a square on its corner, cut along its diagonal
  turned.pose.rotation = Rotation<2>(0.25 * std::numbers::pi);
  world.add(turned);
  BodyDef<2> capsule;
  capsule.shape = 2;
  capsule.pose.position = {10.0, 0.0};
  capsule.pose.rotation = Rotation<2>(0.3);
  world.add(capsule);
  const double whole = world.shapes()[2].volume;
  const auto solid = [&](Vec2 low, Vec2 high) {
    return RegionMeter<2>({.name = "", .box = {low, high}}, extent).read(world, no_ground).solid_volume;
  };
  EXPECT_NEAR(solid({-2.0, 0.0}, {2.0, 2.0}), 0.5, 1e-3);
  EXPECT_NEAR(solid({0.0, -2.0}, {2.0, 2.0}), 0.5, 1e-3);
  EXPECT_NEAR(solid({5.0, -5.0}, {10.0, 5.0}), 0.5 * whole, 2e-3 * whole);
  EXPECT_NEAR(solid({5.0, -5.0}, {15.0, 0.0}), 0.5 * whole, 2e-3 * whole);
}

/// 16 cubes, in 3D 16 rows of 16, side by side on x, y > 0. The one at the origin stands on the ground, and each next
/// one along x is higher by `step`, along y by half of that.
template <int Dim>
class Stairs {
 public:
  explicit Stairs(double step) {
    world_.record_contacts(true);
    constexpr int side = 16;
    for (int y = 0; y < (Dim == 2 ? 1 : side); ++y)
      for (int x = 0; x < side; ++x) add(x + 0.5, y + 0.5, step * x + 0.5 * step * y + 0.5);
    world_.step();
  }

  /// A cube that touches the ground, or else nothing.
  void add(double x, double y, double height, bool touches = true) {
    BodyDef<Dim> body;
    if constexpr (Dim == 2)
      body.pose.position = {x, height};
    else
      body.pose.position = {x, y, height};
    const BodyIndex number = world_.add(body);
    if (touches) world_.touching.push_back({.a = number, .normal_impulse = 1.0});
  }
  Applicable<SurfacePlane> surface(const RegionParams<Dim>& region) {
    world_.step();
    RegionMeter<Dim> meter(region, extent);
    meter.note_contacts(world_);
    return meter.read(world_, no_ground).surface;
  }

  StillWorld<Dim>& world() { return world_; }

 private:
  StillWorld<Dim> world_{description<Dim>()};
};

/// Of the least squares through 16 stairs with two cells on each, over the slope from stair to stair: the variance of
/// the middles of the stairs, over that of the cells.
constexpr double share_of_stairs = ((16.0 * 16.0 - 1.0) / 12.0) / ((32.0 * 32.0 - 1.0) / 48.0);

template <int Dim>
void expect_slope_of_stairs() {
  Stairs<Dim> stairs(0.25);
  const double slope = share_of_stairs * (Dim == 2 ? 0.25 : 0.25 * std::sqrt(1.25));
  const Applicable<SurfacePlane> all = stairs.surface({.name = "", .layer = {0.0, 100.0}});
  ASSERT_TRUE(all.value) << all.why_not;
  EXPECT_NEAR(all.value->angle, std::atan(slope), 1e-9);
  EXPECT_GT(all.value->standard_error, 0.0);
  stairs.add(8.0, 8.0, 50.0, false);
  EXPECT_NEAR(stairs.surface({.name = "", .layer = {0.0, 100.0}}).value->angle, std::atan(slope), 1e-9)
      << "what flies is no part of it";
  stairs.world().touching.clear();
  std::vector<BodyIndex> all_but_the_last(stairs.world().states().size() - 1);
  std::iota(all_but_the_last.begin(), all_but_the_last.end(), 0);
  stairs.world().freeze(all_but_the_last);
  EXPECT_NEAR(stairs.surface({.name = "", .layer = {0.0, 100.0}}).value->angle, std::atan(slope), 1e-9)
      << "what sleeps rests on something";
}

TEST(RegionSlope, OfStairsIsThatOfLeastSquaresAwakeOrAsleep) {
  expect_slope_of_stairs<2>();
  expect_slope_of_stairs<3>();
}

TEST(RegionSlope, IsOnlyThatOfItsOwnPartOfTheSurface) {
  Stairs<2> stairs(0.0);
  for (int x = 16; x < 40; ++x) stairs.add(x + 0.5, 0.0, 0.5 + 0.5 * (x - 15));
  const auto angle = [&](double from, double to) {
    return stairs.surface({.name = "", .box = {{from, 0.0}, {to, 100.0}}}).value->angle;
  };
  EXPECT_NEAR(angle(0.0, 16.0), 0.0, 1e-9);
  EXPECT_NEAR(angle(20.0, 40.0), std::atan(0.5), 0.01);
}

std::string reason(Stairs<2>& stairs, const RegionParams<2>& region) {
  const Applicable<SurfacePlane> surface = stairs.surface(region);
  EXPECT_FALSE(surface.value);
  return surface.why_not;
}

TEST(RegionSlope, IsNotKnownWhereThereIsNoSurfaceAndTheReasonSaysWhy) {
  const RegionParams<2> all = {.name = "", .layer = {-10.0, 100.0}};
  Stairs<2> flat(0.0);
  EXPECT_EQ(reason(flat, {.name = "", .box = {{0.0, 0.0}, {15.0, 2.0}}}),
            "of the bodies inside 15 touch something, fewer than 16");
  for (int x = 0; x < 16; ++x) flat.add(x + 0.5, 0.0, 1.5);
  EXPECT_EQ(reason(flat, {.name = "", .layer = {0.0, 1.0}}), "other bodies lie above those inside");
  Stairs<2> ridge(0.5);
  for (int x = 16; x < 32; ++x) ridge.add(x + 0.5, 0.0, 0.5 * (32 - x));
  EXPECT_NE(reason(ridge, all).find("departs from a plane by 2."), std::string::npos) << "0.29 of 8 m";
  Stairs<2> tower(20.0);
  for (int height = 0; height < 20; ++height) tower.add(-3.0, 0.0, 0.5 + height);
  EXPECT_EQ(reason(tower, {.name = "", .box = {{-4.0, 0.0}, {-2.0, 30.0}}}),
            "the surface is narrower than three strips of D/2");
  ridge.world().set_gravity(Vec2(0.1, -1.0));
  EXPECT_EQ(reason(ridge, all), "gravity is not vertical");
}

}  // namespace
}  // namespace talus::measure_instruments_test

#include "common/sleeper/sleeping_world.h"

#include <gtest/gtest.h>

#include <array>

#include "common/shape/catalogue.h"

namespace talus::sleeping_world_test {
namespace {

/// Cubes far apart, and a contact of the first one with the ground.
struct Cubes {
  SleepingWorld<2> world{Vec2(0.0, -10.0), {}};
  double place = 0.0;

  static Shape<2> cube(double size) { return make_shape<2>("cube", box_pieces<2>(Vec2(size, size)), {}); }
  void add(double size, bool stays_awake) {
    world.add(cube(size), {Vec2(place += 10.0, 0.5 * size), Rotation<2>(0.0)}, stays_awake);
  }
  void prepare() {
    const std::array contacts = {Contact<2>{.a = 0, .b = ground_index, .normal = Vec2::UnitY()}};
    world.prepare(contacts);
  }
};

TEST(SleepingWorld, TakesItsLengthFromTheBodiesThatMaySleep) {
  Cubes cubes;
  for (int i = 0; i < 20; ++i) cubes.add(1.0, true);
  cubes.prepare();
  EXPECT_EQ(cubes.world.extent(), 0.0) << "none may sleep";
  for (int i = 0; i < 10; ++i) cubes.add(0.05, false);
  cubes.prepare();
  EXPECT_NEAR(cubes.world.extent(), Cubes::cube(0.05).extent, 1e-12);
}

TEST(SleepingWorld, TakesItsLengthAnewWhenOtherBodiesHaveTakenTheirPlace) {
  Cubes cubes;
  for (int i = 0; i < 100; ++i) cubes.add(1.0, false);
  cubes.prepare();
  EXPECT_NEAR(cubes.world.extent(), Cubes::cube(1.0).extent, 1e-12);
  for (BodyIndex body = 0; body < 100; ++body) {
    cubes.world.remove(body);
    cubes.add(0.05, false);
    cubes.prepare();
  }
  EXPECT_NEAR(cubes.world.extent(), Cubes::cube(0.05).extent, 1e-12);
}

TEST(SleepingWorld, TakesItsLengthAnewWhenBodiesMaySleepFromNowOn) {
  Cubes cubes;
  for (int i = 0; i < 2; ++i) cubes.add(0.05, false);
  for (int i = 0; i < 10; ++i) cubes.add(1.0, true);
  cubes.prepare();
  EXPECT_NEAR(cubes.world.extent(), Cubes::cube(0.05).extent, 1e-12);
  for (BodyIndex body = 2; body < 12; ++body) cubes.world.keep_awake(body, false);
  cubes.prepare();
  EXPECT_NEAR(cubes.world.extent(), Cubes::cube(1.0).extent, 1e-12);
}

}  // namespace
}  // namespace talus::sleeping_world_test

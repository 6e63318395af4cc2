// When a world counts as at rest.

#include "common/simulation/rest_check.h"

#include <gtest/gtest.h>

#include "tests/common/cubes.h"

namespace talus::rest_check_test {
namespace {

/// A cube of 1 m that lies still and is awake, in gravity of 10 m/s^2.
struct Still {
  /// Steps until the world counts as at rest.
  int steps_to_rest() {
    for (int count = 1;; ++count)
      if (check.update(world, ++step)) return count;
  }
  static Scene<3> scene() {
    Scene<3> scene;
    scene.world = cubes();
    return scene;
  }
  StillWorld<3> world = cubes_at({Vec3(0.0, 0.0, 0.5)});
  RestCheck<3> check{scene()};
  std::int64_t step = 0;
};

// 4 sqrt(D/g) are 1.66 s, twice that from the first look to the second.
TEST(RestCheck, TakesTenTimesAsLongInAHundredthOfTheGravity) {
  Still on_earth;
  const int steps = on_earth.steps_to_rest();
  EXPECT_NEAR(steps, 2 * 1.66 * 60, 4);
  Still elsewhere;
  elsewhere.world.set_gravity(Vec3(0.0, 0.0, -0.1));
  EXPECT_NEAR(elsewhere.steps_to_rest(), 10 * steps, 40);
}

TEST(RestCheck, FindsNoRestAcrossAChangeOfGravity) {
  Still cube;
  const int period = cube.steps_to_rest() / 2;
  EXPECT_EQ(cube.steps_to_rest(), period);
  cube.world.set_gravity(Vec3(10.0, 0.0, 0.0));
  EXPECT_EQ(cube.steps_to_rest(), 2 * period) << "no body has had the time to move";
}

}  // namespace
}  // namespace talus::rest_check_test

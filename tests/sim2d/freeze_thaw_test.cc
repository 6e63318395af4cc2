// Freezing and thawing on Box2D.

#include <gtest/gtest.h>

#include "sim2d/engine_world.h"
#include "tests/sim2d/heap.h"

namespace talus {
namespace {

TEST(FrozenBody, ComesBackToTheSameBits) {
  const auto world = make_box2d_world(l_world());
  add_stack(*world, 40, 8);
  run(*world, 90);  // in full motion
  const std::vector<BodyIndex> all = awake_of(*world);
  const std::vector<Pose<2>> before = world->states().pose;
  world->freeze(all);
  world->thaw(all);
  world->freeze(all);
  run(*world, 3);
  world->thaw(all);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(world->states().pose[i].position, before[i].position);
    EXPECT_EQ(world->states().pose[i].rotation.angle(), before[i].rotation.angle());
  }
}

}  // namespace
}  // namespace talus

// Freezing and thawing on Bullet.

#include <gtest/gtest.h>

#include "sim3d/engine_world.h"
#include "tests/sim3d/heap.h"

namespace talus {
namespace {

const bullet::Engine& engine_of(const World<3>& world) {
  return dynamic_cast<const bullet::EngineWorld<3>&>(world).engine();
}

TEST(FrozenBody, ComesBackToTheSameBits) {
  const auto world = make_bullet_world(l_world<3>());
  add_stack(*world, 40, 3);
  run(*world, 90);  // in full motion
  const std::vector<BodyIndex> all = awake_of(*world);
  const std::vector<Pose<3>> before = world->states().pose;
  world->freeze(all);
  world->thaw(all);
  world->freeze(all);
  run(*world, 3);
  world->thaw(all);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(world->states().pose[i].position, before[i].position);
    EXPECT_EQ(world->states().pose[i].rotation.coeffs(), before[i].rotation.coeffs());
  }
}

TEST(FrozenBody, IsInNoneOfBulletsLists) {
  const auto world = make_bullet_world(l_world<3>());
  add_stack(*world, 40, 3);
  run(*world, 300);
  const bullet::Engine& engine = engine_of(*world);
  EXPECT_EQ(engine.world.listed_objects(), 41);  // with the ground
  EXPECT_GT(engine.pairs.getNumOverlappingPairs(), 40);
  world->freeze(awake_of(*world));
  EXPECT_EQ(engine.world.listed_objects(), 1);
  EXPECT_EQ(engine.world.getNonStaticRigidBodies().size(), 0);
  EXPECT_EQ(engine.pairs.getNumOverlappingPairs(), 0);
  EXPECT_EQ(engine.dispatcher.getNumManifolds(), 0);
  run(*world, 10);
  EXPECT_EQ(engine.pairs.getNumOverlappingPairs(), 0);
}

TEST(FrozenBody, HasPairsOnlyWithTheAwake) {
  const auto world = make_bullet_world(l_world<3>());
  add_stack(*world, 40, 3);
  run(*world, 300);
  std::vector<BodyIndex> even;
  for (BodyIndex body = 0; body < 40; body += 2) {
    even.push_back(body);
  }
  world->freeze(even);
  run(*world, 30);
  const bullet::Engine& engine = engine_of(*world);
  for (int i = 0; i < engine.pairs.getNumOverlappingPairs(); ++i) {
    const btBroadphasePair& pair = engine.pairs.getOverlappingPairArray()[i];
    EXPECT_TRUE(pair.m_pProxy0->m_collisionFilterGroup == btBroadphaseProxy::DefaultFilter ||
                pair.m_pProxy1->m_collisionFilterGroup == btBroadphaseProxy::DefaultFilter);
  }
}

}  // namespace
}  // namespace talus

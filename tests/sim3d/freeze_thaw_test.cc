// Freezing and thawing on Bullet.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim3d/engine_world.h"
#include "tests/sim3d/heap.h"

namespace talus::freeze_thaw_test {
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
  for (BodyIndex body = 0; body < 40; body += 2) even.push_back(body);
  world->freeze(even);
  run(*world, 30);
  const bullet::Engine& engine = engine_of(*world);
  ASSERT_GT(engine.pairs.getNumOverlappingPairs(), 0);
  for (int i = 0; i < engine.pairs.getNumOverlappingPairs(); ++i) {
    const btBroadphasePair& pair = engine.pairs.getOverlappingPairArray()[i];
    EXPECT_TRUE(pair.m_pProxy0->m_collisionFilterGroup == btBroadphaseProxy::DefaultFilter ||
                pair.m_pProxy1->m_collisionFilterGroup == btBroadphaseProxy::DefaultFilter);
  }
}

/// Highest mean speed within the next half second [m/s].
double peak_speed(World<3>& world) {
  double peak = 0.0;
  for (int step = 0; step < 30; ++step) {
    world.step();
    double sum = 0.0;
    for (const Vec3& velocity : world.states().velocity) sum += velocity.norm();
    peak = std::max(peak, sum / world.states().size());
  }
  return peak;
}

/// Peak speed of a heap that was frozen and thawed at rest, over that of one that never was.
double shock_of_waking() {
  WorldDescription<3> description = l_world<3>();
  description.solver.kind = engine_solver;
  const auto never_frozen = make_bullet_world(description);
  const auto thawed = make_bullet_world(description);
  for (World<3>* world : {never_frozen.get(), thawed.get()}) {
    add_stack(*world, 80, 3);
    run(*world, 600);
  }
  const std::vector<BodyIndex> all = awake_of(*thawed);
  thawed->freeze(all);
  run(*thawed, 10);
  thawed->thaw(all);
  return peak_speed(*thawed) / peak_speed(*never_frozen);
}

// Without the impulses of the contacts between sleepers the heap would fall for a step, at g dt = 0.16 m/s, and its
// peak be about four times the other's.
TEST(ThawedHeap, CarriesItselfFromTheFirstStep) { EXPECT_LT(shock_of_waking(), 2.0); }

TEST(ThawedBody, FindsItsContactsInTheFirstStep) {
  const auto world = make_bullet_world(l_world<3>());
  add_stack(*world, 40, 3);
  world->record_contacts(true);
  run(*world, 600);
  const std::vector<Contact<3>> before(world->contacts().begin(), world->contacts().end());
  const std::vector<BodyIndex> all = awake_of(*world);
  world->freeze(all);
  world->thaw(all);
  world->step();
  double weight_before = 0.0;
  double weight_after = 0.0;
  for (const Contact<3>& contact : before) weight_before += contact.b == ground_index ? contact.normal_impulse : 0.0;
  for (const Contact<3>& contact : world->contacts())
    weight_after += contact.b == ground_index ? contact.normal_impulse : 0.0;
  // In one step the solver, which takes over 85 % of each impulse, does not find the balance to the last per cent.
  EXPECT_NEAR(weight_after / weight_before, 1.0, 0.1);
}

TEST(BrokenState, StopsTheWorldAsItWasBeforeTheStep) {
  const auto world = make_bullet_world(l_world<3>());
  add_stack(*world, 40, 3);
  run(*world, 100);
  const std::vector<Pose<3>> before = world->states().pose;
  engine_of(*world).world.getNonStaticRigidBodies()[7]->setLinearVelocity(btVector3(0, NAN, 0));
  for (int attempt = 0; attempt < 2; ++attempt) {
    try {
      world->step();
      FAIL() << "not noticed";
    } catch (const NonFiniteState& error) {
      EXPECT_EQ(error.step, 101);
    }
  }
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(world->states().pose[i].position, before[i].position);
}

TEST(RemovedBody, TakesItsPairsAlongAsleepOrAwake) {
  const auto world = make_bullet_world(l_world<3>());
  add_stack(*world, 40, 3);
  run(*world, 300);
  const std::vector<BodyIndex> some = {3, 11, 12, 20};
  world->freeze(some);
  run(*world, 5);
  world->remove(11);
  world->remove(12);
  world->remove(25);
  run(*world, 5);
  world->thaw(std::vector<BodyIndex>{3, 20});
  run(*world, 60);
  EXPECT_EQ(engine_of(*world).world.listed_objects(), 38);  // with the ground
  EXPECT_EQ(world->awake().size(), 37U);
}

TEST(RemovedBody, LeavesBulletsListsWhereSleepersAreInThem) {
  WorldDescription<3> description = l_world<3>();
  description.debug.keep_sleepers = true;
  const auto world = make_bullet_world(description);
  add_stack(*world, 4, 2);
  world->freeze(std::vector<BodyIndex>{0, 1});
  EXPECT_EQ(engine_of(*world).world.listed_objects(), 5);  // with the ground
  world->remove(0);
  EXPECT_EQ(engine_of(*world).world.listed_objects(), 4);
  run(*world, 5);
}

}  // namespace
}  // namespace talus::freeze_thaw_test

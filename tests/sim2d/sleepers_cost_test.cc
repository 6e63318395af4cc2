// What sleepers cost: exactly, by what the engine holds, and roughly, by the clock.

#include <gtest/gtest.h>

#include <ctime>

#include "sim2d/engine_world.h"
#include "tests/sim2d/heap.h"

namespace talus::sleepers_cost_test {
namespace {

const b2World& engine_of(const World<2>& world) { return dynamic_cast<const box2d::EngineWorld&>(world).engine(); }

/// Sleepers in a bed 20 deep, frozen where they are put.
std::unique_ptr<World<2>> bed_of_sleepers(int count) {
  auto world = make_box2d_world(l_world());
  std::vector<BodyIndex> batch;
  for (int i = 0; i < count; ++i) {
    const int column = i / 20 - count / 40;
    BodyDef<2> body;
    body.pose.position = {1.02 * column, 0.6 + 1.02 * (i % 20)};
    batch.push_back(world->add(body));
    if (batch.size() == 100 || i + 1 == count) {
      world->freeze(batch);
      batch.clear();
    }
  }
  return world;
}

void drop(World<2>& world, int count) {
  for (int i = 0; i < count; ++i) {
    const int row = i / 10;
    BodyDef<2> body;
    body.pose.position = {1.5 * (i % 10) - 7.0, 22.0 + 1.5 * row};
    world.add(body);
  }
}

TEST(Sleepers, AreNoBodiesOfTheEngineAndHaveNoContacts) {
  const auto world = bed_of_sleepers(2000);
  EXPECT_EQ(engine_of(*world).GetBodyCount(), 1 + 250);  // the ground and 2000 / 8 hosts
  drop(*world, 20);
  run(*world, 120);
  EXPECT_EQ(engine_of(*world).GetBodyCount(), 1 + 250 + 20);
  EXPECT_GT(engine_of(*world).GetContactCount(), 0);
  for (const b2Contact* contact = engine_of(*world).GetContactList(); contact != nullptr;
       contact = contact->GetNext()) {
    EXPECT_TRUE(contact->GetFixtureA()->GetBody()->GetType() == b2_dynamicBody ||
                contact->GetFixtureB()->GetBody()->GetType() == b2_dynamicBody);
  }
  world->freeze(awake_of(*world));
  world->step();
  EXPECT_EQ(engine_of(*world).GetContactCount(), 0);
}

TEST(Sleepers, LeaveNothingBehindWhenTheyWakeOrGo) {
  const auto world = bed_of_sleepers(300);
  std::vector<BodyIndex> all;
  for (BodyIndex body = 0; body < 300; ++body) all.push_back(body);
  world->thaw(all);
  EXPECT_EQ(engine_of(*world).GetBodyCount(), 1 + 300);
  world->freeze(all);
  for (const BodyIndex body : all) world->remove(body);
  EXPECT_EQ(engine_of(*world).GetBodyCount(), 1);
  EXPECT_EQ(engine_of(*world).GetProxyCount(), 1);
}

TEST(Sleepers, NeedNoMoreHostsHoweverOftenTheyChange) {
  const auto world = bed_of_sleepers(1000);
  std::mt19937 random(4);
  for (int round = 0; round < 300; ++round) {
    const std::vector<BodyIndex> some = {static_cast<BodyIndex>(random() % 1000),
                                         static_cast<BodyIndex>(random() % 1000)};
    world->thaw(some);
    world->step();
    world->freeze(some);
  }
  EXPECT_LE(engine_of(*world).GetBodyCount(), 1 + 125 + 1);
}

double step_time(World<2>& world, int steps) {
  double best = 1e9;  // the least of several disturbs least on a busy machine
  for (int repeat = 0; repeat < 8; ++repeat) {
    const std::clock_t start = std::clock();  // of this process
    run(world, steps);
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / steps);
  }
  return best;
}

// A cost of each of twenty times the sleepers would show as up to twenty times. Twice leaves room for a busy machine.
TEST(Sleepers, DoNotSlowDownAStep) {
  const auto few = bed_of_sleepers(1000);
  const auto many = bed_of_sleepers(20000);
  drop(*few, 50);
  drop(*many, 50);
  run(*few, 150);
  run(*many, 150);
  EXPECT_LE(step_time(*many, 20), 2.0 * step_time(*few, 20));
}

TEST(Sleepers, AloneCostNothing) {
  const auto world = bed_of_sleepers(20000);
  world->step();
  EXPECT_LE(step_time(*world, 1000), 2e-5);  // a nanosecond a sleeper
}

}  // namespace
}  // namespace talus::sleepers_cost_test

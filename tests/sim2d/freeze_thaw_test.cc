// Freezing and thawing on Box2D, where contacts and their impulses die with the fixtures that are exchanged.

#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "sim2d/engine_world.h"
#include "tests/sim2d/heap.h"

namespace talus::freeze_thaw_test {
namespace {

/// Position, angle and transform that the engine itself holds for each awake body.
std::map<BodyIndex, std::array<float, 5>> engine_poses(const World<2>& world) {
  const b2World& engine = dynamic_cast<const box2d::EngineWorld&>(world).engine();
  std::map<BodyIndex, std::array<float, 5>> poses;
  for (const b2Body* body = engine.GetBodyList(); body != nullptr; body = body->GetNext()) {
    if (body->GetType() == b2_dynamicBody) {
      auto& fixture = const_cast<b2Fixture&>(*body->GetFixtureList());
      const b2Transform& at = body->GetTransform();
      poses[box2d::owner_of(fixture)] = {at.p.x, at.p.y, body->GetAngle(), at.q.s, at.q.c};
    }
  }
  return poses;
}

TEST(FrozenBody, ComesBackToTheSameBitsInTheEngine) {
  const auto world = make_box2d_world(l_world());
  add_stack(*world, 40, 8);
  run(*world, 90);  // in full motion
  const std::vector<BodyIndex> all = awake_of(*world);
  const auto before = engine_poses(*world);
  ASSERT_EQ(before.size(), 40U);
  world->freeze(all);
  world->thaw(all);
  world->freeze(all);
  run(*world, 3);
  world->thaw(all);
  EXPECT_EQ(engine_poses(*world), before);
}

/// Largest mean speed [m/s] and mean way [m] within a second.
struct Unrest {
  double peak = 0.0;
  double drift = 0.0;
};

Unrest unrest(World<2>& world) {
  const std::vector<Pose<2>> before = world.states().pose;
  const auto count = static_cast<double>(before.size());
  Unrest result;
  for (int step = 0; step < 60; ++step) {
    world.step();
    double sum = 0.0;
    for (const Vec2& velocity : world.states().velocity) sum += velocity.norm();
    result.peak = std::max(result.peak, sum / count);
  }
  for (std::size_t i = 0; i < before.size(); ++i)
    result.drift += (world.states().pose[i].position - before[i].position).norm() / count;
  return result;
}

/// A heap of 120 at rest, always the same one.
std::unique_ptr<World<2>> settled_heap() {
  auto world = make_box2d_world(l_world());
  add_stack(*world, 120, 8);
  run(*world, 1200);
  return world;
}

// Twice what the heap does anyway, plus 0.2 mm/s and 0.02 mm for a heap that does nothing. Without saved impulses such
// heaps reach 0.2 to 0.5 m/s and 25 to 80 mm.
void expect_as_calm(const Unrest& thawed, const Unrest& never_frozen) {
  EXPECT_LE(thawed.peak, 2.0 * never_frozen.peak + 2e-4);
  EXPECT_LE(thawed.drift, 2.0 * never_frozen.drift + 2e-5);
}

TEST(ThawedHeap, IsAsCalmAsOneNeverFrozen) {
  const Unrest never_frozen = unrest(*settled_heap());
  const auto world = settled_heap();
  const std::vector<BodyIndex> all = awake_of(*world);
  world->freeze(all);
  run(*world, 120);
  world->thaw(all);
  expect_as_calm(unrest(*world), never_frozen);
}

TEST(ThawedHeap, IsCalmTooWhenItFrozeAndThawedInParts) {
  const Unrest never_frozen = unrest(*settled_heap());
  const auto world = settled_heap();
  const std::vector<BodyIndex> all = awake_of(*world);
  for (std::size_t first = 0; first < all.size(); first += 10) {
    world->freeze(std::span(all).subspan(first, 10));
    world->step();
  }
  EXPECT_TRUE(world->awake().empty());
  for (std::size_t first = 0; first < all.size(); first += 30) {
    world->thaw(std::span(all).subspan(first, 30));
    world->step();
  }
  // Bodies between sleepers rest against walls meanwhile, so a share of their impulses is no longer the heap's own.
  const Unrest thawed = unrest(*world);
  EXPECT_LE(thawed.peak, 5.0 * never_frozen.peak + 5e-3);
  EXPECT_LE(thawed.drift, 5.0 * never_frozen.drift + 1e-3);
}

TEST(ThawedBody, NeitherWakesNorMovesSleepersBesideIt) {
  const auto world = settled_heap();
  const std::vector<BodyIndex> all = awake_of(*world);
  world->freeze(all);
  const std::vector<Pose<2>> before = world->states().pose;
  const std::vector<BodyIndex> one = {60};
  world->thaw(one);
  run(*world, 60);
  EXPECT_EQ(awake_of(*world), one);
  for (const BodyIndex body : all) {
    const double way = (world->states().pose[body].position - before[body].position).norm();
    EXPECT_LE(way, body == 60 ? 1e-3 : 0.0) << body;
  }
}

TEST(FrozenBody, StopsWhatFallsFastHoweverThinItIs) {
  WorldDescription<2> description;
  description.gravity = 0.0;
  description.shapes = {make_shape<2>("plate", box_pieces<2>({2.0, 0.02}), Material{}),
                        make_shape<2>("ball", ball_pieces<2>(0.05), Material{})};
  description.shapes[0].material.density = 10.0;
  int through = 0;
  for (int phase = 0; phase < 60; ++phase) {
    const auto world = make_box2d_world(description);
    const std::vector<BodyIndex> plate = {world->add({})};
    world->freeze(plate);
    BodyDef<2> ball{1, {}, {0.0, -110.0}, Spin<2>::Zero()};
    ball.pose.position = {0.0, 3.0 + phase / 30.0};
    world->add(ball);
    run(*world, 10);
    through += world->states().pose[1].position.y() < 0.0 ? 1 : 0;
  }
  EXPECT_EQ(through, 0);
}

TEST(FrozenBody, IsThawedFromTheEnginesOwnSleepToo) {
  WorldDescription<2> description = l_world();
  description.solver.kind = engine_solver;
  description.engine_sleep = true;
  const auto world = make_box2d_world(description);
  add_stack(*world, 4, 4);
  run(*world, 600);
  ASSERT_TRUE(world->awake().empty());
  const std::vector<BodyIndex> all = {0, 1, 2, 3};
  world->freeze(all);  // asleep already, hence left alone
  world->thaw(all);
  EXPECT_EQ(awake_of(*world), all);
  world->freeze(all);
  EXPECT_TRUE(world->awake().empty());
  run(*world, 60);
  world->thaw(all);
  run(*world, 60);
  EXPECT_TRUE(world->awake().empty());
}

}  // namespace
}  // namespace talus::freeze_thaw_test

// Rule by rule through sections 3.3 and 3.4 of the paper, on bodies that stand still where they are put.

#include "common/policy/paper_policy.h"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "common/shape/catalogue.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "tests/common/still_world.h"

namespace talus::paper_policy_test {
namespace {

/// Unit cubes of 1 kg: v_obj = 1, D = sqrt(3). One pile at the origin whose structure never grows or drifts.
Scene<3> cubes(double structure_size) {
  Scene<3> scene;
  scene.world.shapes.push_back(make_shape<3>("cube", box_pieces<3>(Vec3::Ones()), {.density = 1.0}));
  PileParams<3> pile;
  pile.alpha = std::numbers::pi / 4.0;
  pile.at = Vec3::Zero();
  pile.initial_size = structure_size;
  pile.growth_ratio = 1.0;
  pile.drift_rate = 0.0;
  scene.piles.push_back(pile);
  scene.policy.kind = "paper";
  return scene;
}

/// A simulation of `scene` in a still world, to which bodies are added by hand.
struct StillRun {
  explicit StillRun(const Scene<3>& scene)
      : simulation(scene, std::make_unique<StillWorld<3>>(scene.world), make_policy(scene)) {}

  BodyIndex add(const Vec3& at, const Vec3& velocity = Vec3::Zero()) {
    return simulation.add({.pose = {.position = at}, .velocity = velocity});
  }
  void add_many(int count, const Vec3& at) {
    for (int i = 0; i < count; ++i) add(at);
  }
  bool asleep(BodyIndex body) const { return simulation.world().states().asleep[body] != 0; }
  const Layer& layer(std::size_t i) const { return simulation.piles().piles().front().layers[i]; }

  Simulation<3> simulation;
};

TEST(SleepScore, IsDensityTimesClosenessTimesSlowness) {
  EXPECT_DOUBLE_EQ(sleep_score(0.7, 0.75, 3.0), 0.7 * 0.75 * 0.25);
}

TEST(PaperPolicy, PutsABodyToSleepThatIsDenseCentralAndSlow) {
  StillRun run(cubes(4.0));  // one layer with room for 4
  run.add_many(2, Vec3(0.0, 0.0, 0.5));
  const BodyIndex third = run.add(Vec3(0.0, 0.0, 0.5));
  run.simulation.step();  // density 3/4, on the axis, at rest: score 0.75 > 0.5
  EXPECT_TRUE(run.asleep(third));
}

TEST(PaperPolicy, LeavesABodyAwakeInAThinLayer) {
  StillRun run(cubes(4.0));
  const BodyIndex body = run.add(Vec3(0.0, 0.0, 0.5));
  run.add(Vec3(0.0, 0.0, 0.5));
  run.simulation.step();  // density 2/4: score 0.5, not above tau
  EXPECT_FALSE(run.asleep(body));
}

TEST(PaperPolicy, LeavesABodyAwakeFarFromTheCentre) {
  StillRun run(cubes(4.0));
  run.add_many(2, Vec3(0.0, 0.0, 0.5));
  const BodyIndex far = run.add(Vec3(0.4 * run.layer(0).radius, 0.0, 0.5));
  run.simulation.step();  // 0.75 * 0.6 = 0.45
  EXPECT_FALSE(run.asleep(far));
}

TEST(PaperPolicy, LeavesAFastBodyAwake) {
  StillRun run(cubes(4.0));
  run.add_many(2, Vec3(0.0, 0.0, 0.5));
  const BodyIndex fast = run.add(Vec3(0.0, 0.0, 0.5), Vec3(0.6, 0.0, 0.0));
  run.simulation.step();  // 0.75 / 1.6 = 0.47
  EXPECT_FALSE(run.asleep(fast));
}

TEST(PaperPolicy, LetsALayerSleepOnlyWhenEveryLayerBelowHoldsASleeper) {
  StillRun run(cubes(60.0));  // h = cbrt(3 * 60 / pi) = 3.86 m: two layers of 1.93 m, radii 3.86 and 1.93 m
  ASSERT_EQ(run.simulation.piles().piles().front().layers.size(), 2U);
  const int above = static_cast<int>(0.7 * run.layer(1).capacity);
  run.add_many(above, Vec3(0.0, 0.0, 2.5));
  run.simulation.step();
  EXPECT_EQ(run.layer(1).sleeping, 0) << "the layer below is empty";
  run.add_many(static_cast<int>(0.7 * run.layer(0).capacity), Vec3(0.0, 0.0, 0.5));
  run.simulation.step();
  EXPECT_GT(run.layer(0).sleeping, 0);
  EXPECT_EQ(run.layer(1).sleeping, 0) << "the layer below fell asleep in this very step";
  run.simulation.step();
  EXPECT_GT(run.layer(1).sleeping, 0);
}

TEST(BodyInSeveralPiles, SleepsOnceByThePileThatScoresItHighest) {
  for (const std::size_t small : {0U, 1U}) {
    Scene<3> scene = cubes(4.0);
    scene.piles.push_back(scene.piles.front());
    scene.piles[1 - small].initial_size = 1000.0;  // hardly filled
    for (PileParams<3>& pile : scene.piles) pile.merge_distance = 0.0;
    StillRun run(scene);
    run.add_many(3, Vec3(0.0, 0.0, 0.5));
    run.simulation.step();
    ASSERT_EQ(run.simulation.frame().events.size(), 3U);
    for (const SleepEvent& event : run.simulation.frame().events) {
      EXPECT_EQ(event.pile, static_cast<int>(small));
      EXPECT_DOUBLE_EQ(event.score, 0.75);
    }
  }
}

TEST(Avalanche, WakesAllOfAPileWhoseLayerIsOverfullAndKeepsItAwakeForAWhile) {
  Scene<3> scene = cubes(10.0);
  scene.policy.paper.awake_steps = 5;
  StillRun run(scene);
  run.add_many(7, Vec3(0.0, 0.0, 0.5));
  run.simulation.step();
  EXPECT_EQ(run.layer(0).sleeping, 7);
  run.add_many(2, Vec3(0.9 * run.layer(0).radius, 0.0, 0.5));  // density 9/10 > 0.8; too far out to sleep
  run.simulation.step();
  EXPECT_EQ(run.layer(0).sleeping, 0);
  const auto events = run.simulation.frame().events;
  ASSERT_EQ(events.size(), 7U);
  EXPECT_EQ(events.front().cause, SleepCause::avalanche);
  EXPECT_TRUE(events.front().woke);
  for (int i = 0; i < 4; ++i) {
    run.simulation.step();
    EXPECT_EQ(run.layer(0).sleeping, 0) << "within the steps after the avalanche";
  }
}

TEST(Avalanche, HasAThresholdForEachLayer) {
  Scene<3> scene = cubes(4.0);
  scene.policy.paper.avalanche_density = {2.0, 0.1};  // one layer only: the first holds
  StillRun run(scene);
  run.add_many(4, Vec3(0.0, 0.0, 0.5));  // density 1
  run.simulation.step();
  run.simulation.step();
  EXPECT_EQ(run.layer(0).sleeping, 4);
  EXPECT_EQ(scene.policy.paper.avalanche_density_of(0), 2.0);
  EXPECT_EQ(scene.policy.paper.avalanche_density_of(7), 0.1);
}

TEST(MomentumWake, WakesAPileBeforeSomethingHeavyAndFastReachesIt) {
  Scene<3> scene = cubes(4.0);
  scene.policy.paper.wake_speed = 10.0;  // typical body 1 kg: from 10 N s
  StillRun run(scene);
  run.add_many(3, Vec3(0.0, 0.0, 0.5));
  run.simulation.step();
  EXPECT_EQ(run.layer(0).sleeping, 3);
  // Its lower face is 0.3 m above the sleepers; within two steps of 1/60 s at 12 m/s it falls 0.4 m.
  run.add(Vec3(0.0, 0.0, 1.8), Vec3(0.0, 0.0, -12.0));
  run.simulation.step();
  EXPECT_EQ(run.layer(0).sleeping, 0);
  EXPECT_EQ(run.simulation.frame().events.front().cause, SleepCause::momentum);
}

TEST(MomentumWake, IgnoresWhatArrivesGently) {
  Scene<3> scene = cubes(4.0);
  scene.policy.paper.wake_speed = 10.0;
  scene.policy.paper.avalanche_density = {100.0};
  StillRun run(scene);
  run.add_many(3, Vec3(0.0, 0.0, 0.5));
  run.simulation.step();
  run.add(Vec3(0.0, 0.0, 1.55), Vec3(0.0, 0.0, -9.0));
  run.simulation.step();
  EXPECT_EQ(run.layer(0).sleeping, 3);
}

TEST(SleepEvents, CarryBodyPileLayerCauseAndScore) {
  StillRun run(cubes(4.0));
  run.add_many(3, Vec3(0.0, 0.0, 0.5));
  run.simulation.step();
  const auto events = run.simulation.frame().events;
  ASSERT_EQ(events.size(), 3U);
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].body, static_cast<BodyIndex>(i)) << "in body order";
    EXPECT_EQ(events[i].step, 1);
    EXPECT_EQ(events[i].pile, 0);
    EXPECT_EQ(events[i].layer, 0);
    EXPECT_FALSE(events[i].woke);
    EXPECT_EQ(events[i].cause, SleepCause::score);
    EXPECT_DOUBLE_EQ(events[i].score, 0.75);
  }
}

TEST(RemovedBody, WakesTheSleepersAroundIt) {
  StillRun run(cubes(4.0));
  const BodyIndex support = run.add(Vec3(0.0, 0.0, 0.5));
  const BodyIndex resting = run.add(Vec3(0.0, 0.0, 1.5));
  run.add(Vec3(0.0, 0.0, 0.5));
  run.simulation.step();
  ASSERT_TRUE(run.asleep(resting));
  run.simulation.remove(support);
  EXPECT_FALSE(run.asleep(resting));
}

}  // namespace
}  // namespace talus::paper_policy_test

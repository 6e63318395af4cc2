#include <gtest/gtest.h>

#include <memory>

#include "common/measure/avalanches.h"
#include "common/shape/catalogue.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "tests/common/still_world.h"

namespace talus::measure_avalanches_test {
namespace {

/// Eight unit cubes in a one-layer pile with room for four: asleep in the first step, woken when it is overfull.
struct OverfullPile {
  static Scene<3> scene() {
    Scene<3> scene;
    scene.world.shapes.push_back(make_shape<3>("cube", box_pieces<3>(Vec3::Ones()), {.density = 1.0}));
    PileParams<3> pile;
    pile.at = Vec3::Zero();
    pile.initial_size = 4.0;
    pile.growth_ratio = 1.0;
    pile.drift_rate = 0.0;
    scene.piles.push_back(pile);
    scene.policy.kind = "paper";
    return scene;
  }

  OverfullPile() : simulation(scene(), std::make_unique<StillWorld<3>>(scene().world), make_policy(scene())) {
    simulation.add_observer(watch);
    for (int i = 0; i < 3; ++i) simulation.add({.pose = {.position = Vec3(0.0, 0.0, 0.5)}});
    simulation.step();  // density 3/4: asleep
    simulation.add({.pose = {.position = Vec3(0.0, 0.0, 0.5)}});
    simulation.step();  // density 1: an avalanche
  }
  Simulation<3> simulation;
  AvalancheWatch<3> watch{1.0 / 60.0, 0.05};
};

TEST(AvalancheWatch, TellsWhichLayerWokeHowManyAndHowLongTheyTook) {
  OverfullPile pile;
  EXPECT_TRUE(pile.watch.records().empty());
  pile.simulation.step();  // nothing moves in a still world: quiet after a step
  ASSERT_EQ(pile.watch.records().size(), 1U);
  const Avalanche& record = pile.watch.records().front();
  EXPECT_EQ(record.step, 2);
  EXPECT_EQ(record.pile, 0);
  EXPECT_EQ(record.layer, 0);
  EXPECT_DOUBLE_EQ(record.density, 1.0);
  EXPECT_EQ(record.woken, 3);
  EXPECT_DOUBLE_EQ(record.seconds, 1.0 / 60.0);
  EXPECT_EQ(record.longest_way, 0.0);
}

TEST(AvalancheWatch, DoesNotWaitForABodyThatWasRemovedAsItMoved) {
  OverfullPile pile;
  pile.simulation.do_event({.action = EventAction::kick, .numbers = {0}, .velocity = Vec3(1.0, 0.0, 0.0)});
  pile.simulation.remove(0);
  pile.simulation.step();
  ASSERT_EQ(pile.watch.records().size(), 1U);
  EXPECT_DOUBLE_EQ(pile.watch.records().front().seconds, 1.0 / 60.0);
}

TEST(AvalancheWatch, KeepsOneThatLastsToTheEndOfTheRun) {
  OverfullPile pile;
  pile.simulation.end("finished");
  ASSERT_EQ(pile.watch.records().size(), 1U);
  EXPECT_EQ(pile.watch.records().front().seconds, -1.0);
}

}  // namespace
}  // namespace talus::measure_avalanches_test

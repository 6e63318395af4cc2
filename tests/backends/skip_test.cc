// What a step leaves out must not be missed: put back, it changes nothing.

#include <fmt/format.h>

#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "common/simulation/state_hash.h"
#include "tests/backends/backend.h"

namespace talus::skip_test {
namespace {

/// What a run of a scene was like.
struct Outcome {
  std::uint64_t hash = 0;
  int idle_steps = 0;  // with bodies, but nobody awake
  int woken = 0;
  std::int64_t frames_seen = 0;

  bool operator==(const Outcome&) const = default;
};

template <typename Backend>
class SkipTest : public BackendTest<Backend> {
 protected:
  static constexpr int dimension = Backend::dim;

  /// L's poured in two strings with a pause in which all fall asleep.
  static Scene<dimension> two_strings(const std::string& policy) {
    Scene<dimension> scene;
    scene.world = BackendTest<Backend>::description({.friction = 0.6});
    scene.policy.kind = policy;
    Source<dimension> source;
    source.shapes = {2};
    source.count = 15;
    source.position = up<dimension>(6.0);
    source.velocity = -up<dimension>(10.0);
    scene.sources = {source, source};
    scene.sources[1].start = 7.0;
    scene.piles.resize(1);
    return scene;
  }

  static Outcome run(const Scene<dimension>& scene) {
    struct Watch final : Observer<dimension> {
      void on_frame(const Frame<dimension>& frame) override {
        outcome.frames_seen = frame.step;
        outcome.idle_steps += frame.world.awake().empty() && frame.world.states().size() > 0 ? 1 : 0;
        for (const SleepEvent& event : frame.events) outcome.woken += event.woke ? 1 : 0;
      }
      Outcome outcome;
    } watch;
    Simulation<dimension> simulation(scene, Backend::make(scene.world), make_policy(scene));
    simulation.add_observer(watch);
    for (int step = 0; step < 720; ++step) simulation.step();
    watch.outcome.hash = state_hash(simulation.world().states());
    return watch.outcome;
  }
};
TYPED_TEST_SUITE(SkipTest, Backends, BackendName);

TYPED_TEST(SkipTest, ASkipSwitchedOffGivesTheSameBits) {
  for (const char* policy : {"full", "engine", "paper", "adaptive"}) {
    Scene<TypeParam::dim> scene = this->two_strings(policy);
    const Outcome all_on = this->run(scene);
    for (const Skip& skip : all_skips) {
      if (!skip.exact) continue;
      scene.world.skips = {};
      scene.world.skips.*skip.field = false;
      EXPECT_EQ(this->run(scene), all_on) << policy << " without " << skip.name;
    }
  }
}

TYPED_TEST(SkipTest, WhatBouncesMeetsTheGroundAsIfItHadBeenWatchedInFlight) {
  Scene<TypeParam::dim> scene = this->two_strings("full");
  for (Shape<TypeParam::dim>& shape : scene.world.shapes) shape.material.restitution = 0.8;
  scene.world.ground.material.restitution = 0.8;
  scene.sources[0].count = 4;
  scene.sources[0].spin_spread = 5.0;
  const Outcome spared = this->run(scene);
  scene.world.skips.flight = false;
  EXPECT_EQ(this->run(scene), spared);
}

TYPED_TEST(SkipTest, TheTestSceneRestsInBetweenAndWakes) {
  const Outcome outcome = this->run(this->two_strings("adaptive"));
  EXPECT_GT(outcome.idle_steps, 20);
  EXPECT_GT(outcome.woken, 0);
  EXPECT_EQ(outcome.frames_seen, 720) << "observers see each step of a world at rest";
}

TYPED_TEST(SkipTest, SlowBodiesSparedContinuousCollisionDoNotSinkIn) {
  Scene<TypeParam::dim> scene = this->two_strings("adaptive");
  for (const bool spared : {true, false}) {
    scene.world.skips.continuous = spared;
    Simulation<TypeParam::dim> simulation(scene, TypeParam::make(scene.world), make_policy(scene));
    for (int step = 0; step < 720; ++step) simulation.step();
    for (const Pose<TypeParam::dim>& pose : simulation.world().states().pose) {
      // An L's centre of mass lies 0.2 m above the ground or higher, but for 2 cm that the engines let overlap.
      EXPECT_GT(height<TypeParam::dim>(pose.position), 0.18);
    }
  }
}

}  // namespace
}  // namespace talus::skip_test

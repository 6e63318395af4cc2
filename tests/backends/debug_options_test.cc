// Work that a step leaves out changes nothing when a debug option puts it back.

#include <array>
#include <span>
#include <utility>

#include "common/simulation/simulation.h"
#include "common/simulation/state_hash.h"
#include "tests/backends/backend.h"

namespace talus::debug_options_test {
namespace {

using Option = std::pair<bool DebugOptions::*, const char*>;
constexpr std::array options_of_the_same_bits = {
    Option{&DebugOptions::step_when_idle, "step_when_idle"},
    Option{&DebugOptions::keep_sleepers, "keep_sleepers"},
    Option{&DebugOptions::recount_sleepers, "recount_sleepers"},
    Option{&DebugOptions::gather_contacts, "gather_contacts"},
};

/// What a run of a scene was like.
struct Outcome {
  std::uint64_t hash = 0;
  int idle_steps = 0;  // with bodies, none of them awake
  int woken = 0;
  std::int64_t frames_seen = 0;

  bool operator==(const Outcome&) const = default;
};

template <typename Backend>
class DebugOptionsTest : public BackendTest<Backend> {
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
    scene.sources[1].start = 10.0;
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
    auto simulation = simulation_on<Backend>(scene);
    simulation.add_observer(watch);
    for (int step = 0; step < 900; ++step) simulation.step();
    watch.outcome.hash = state_hash(simulation.world().states());
    return watch.outcome;
  }

  static void expect_same_bits(std::span<const Option> options) {
    for (const char* policy : {"full", "engine", "paper", "adaptive"}) {
      if (!has_policy<Backend>(policy)) continue;
      Scene<dimension> scene = two_strings(policy);
      const Outcome without = run(scene);
      for (const auto& [option, name] : options) {
        scene.world.debug = {};
        scene.world.debug.*option = true;
        EXPECT_EQ(run(scene), without) << policy << " with " << name;
      }
    }
  }
};
TYPED_TEST_SUITE(DebugOptionsTest, Backends, BackendName);

TYPED_TEST(DebugOptionsTest, PutBackWorkWithoutAChangeOfTheBits) { this->expect_same_bits(options_of_the_same_bits); }

TYPED_TEST(DebugOptionsTest, TheTestSceneRestsInBetweenAndWakes) {
  const Outcome outcome = this->run(this->two_strings("adaptive"));
  EXPECT_GT(outcome.idle_steps, 10);
  EXPECT_GT(outcome.woken, 0);
  EXPECT_EQ(outcome.frames_seen, 900) << "observers see each step of a world at rest";
}

TYPED_TEST(DebugOptionsTest, SlowBodiesWithoutContinuousCollisionDoNotSinkIn) {
  Scene<TypeParam::dim> scene = this->two_strings("adaptive");
  for (const bool swept : {false, true}) {
    scene.world.debug.sweep_slow_bodies = swept;
    auto simulation = simulation_on<TypeParam>(scene);
    for (int step = 0; step < 900; ++step) simulation.step();
    for (const Pose<TypeParam::dim>& pose : simulation.world().states().pose) {
      // An L's centre of mass lies 0.2 m above the ground or higher, but for 2 cm that the engines let overlap.
      EXPECT_GT(height<TypeParam::dim>(pose.position), 0.18);
    }
  }
}

#ifdef TALUS_BULLET
constexpr std::array options_of_bullet = {
    Option{&DebugOptions::collide_in_flight, "collide_in_flight"},
    Option{&DebugOptions::bullet_compounds, "bullet_compounds"},
    Option{&DebugOptions::visit_separate_pairs, "visit_separate_pairs"},
};

template <typename Backend>
class BulletDebugOptions : public DebugOptionsTest<Backend> {};
TYPED_TEST_SUITE(BulletDebugOptions, BulletBackends, BackendName);

TYPED_TEST(BulletDebugOptions, PutBackWorkWithoutAChangeOfTheBits) { this->expect_same_bits(options_of_bullet); }

TYPED_TEST(BulletDebugOptions, ABouncingBodyHitsTheGroundAsIfItCollidedInFlight) {
  Scene<TypeParam::dim> scene = this->two_strings("full");
  for (Shape<TypeParam::dim>& shape : scene.world.shapes) shape.material.restitution = 0.8;
  scene.world.ground.material.restitution = 0.8;
  scene.sources[0].count = 4;
  scene.sources[0].spin_spread = 5.0;
  const Outcome without = this->run(scene);
  scene.world.debug.collide_in_flight = true;
  EXPECT_EQ(this->run(scene), without);
}
#endif

}  // namespace
}  // namespace talus::debug_options_test

// Which bodies sleep: events, policy and world must agree whatever is done to a run, on every engine.

#include <fmt/format.h>

#include <random>

#include "common/policy/adaptive/adaptive_policy.h"
#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "tests/backends/backend.h"

namespace talus::sleep_account_test {
namespace {

/// Sixteen cubes of 1 m side by side on the ground, from x = -8.25 m to 8.25 m, and what `rest` adds.
template <int Dim>
Scene<Dim> row(const std::string& rest = "", const std::string& policy = "adaptive") {
  const std::string text = fmt::format(
      "title = \"Row\"\ndimension = {}\npolicy.kind = \"{}\"\nrun = {{frames = 9000}}\npile = [{{alpha_deg = 30}}]\n"
      "shape.cube = {{kind = \"box\", size = {}, friction = 0.8}}\n"
      "[[body]]\nposition = {}\nrepeat = {}\nstep = {}\n{}",
      Dim, policy, Dim == 2 ? "[1, 1]" : "[1, 1, 1]", vector_text<Dim>(0, 0.5), Dim == 2 ? "[16, 1]" : "[16, 1, 1]",
      Dim == 2 ? "[1.1, 1]" : "[1.1, 1, 1]", rest);
  return std::get<Scene<Dim>>(parse_scene(text, "text"));
}

/// An obstacle that shuttles in the row's way and a platform that stands still.
template <int Dim>
std::string obstacles() {
  return fmt::format(
      "[[obstacle]]\nname = \"shuttle\"\nkind = \"box\"\nsize = {0}\nposition = {1}\n"
      "motion = {{kind = \"path\", times = [1, 2, 3, 4, 6], shifts = [{2}, {3}, {3}, {2}, {3}]}}\n"
      "[[obstacle]]\nname = \"platform\"\nkind = \"box\"\nsize = {0}\nposition = {4}\n"
      "[[event]]\ntime = 5\ndo = \"remove\"\nobstacle = \"platform\"\n"
      "[[event]]\ntime = 7\ndo = \"policy\"\npolicy = \"paper\"\n"
      "[[event]]\ntime = 8\ndo = \"policy\"\npolicy = \"adaptive\"\n",
      Dim == 2 ? "[1, 1]" : "[1, 1, 1]", vector_text<Dim>(-9.45, 0.5), vector_text<Dim>(0, 0), vector_text<Dim>(0.5, 0),
      vector_text<Dim>(40, 0.5));
}

template <int Dim>
Event<Dim> gravity(double size) {
  return {.action = EventAction::gravity, .gravity = -up<Dim>(size)};
}

template <typename Backend>
class SleepAccount : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;
  /// Steps; returns how many bodies checks woke.
  static int steps(Simulation<dimension>& simulation, int count) {
    int woken = 0;
    for (int i = 0; i < count; ++i) {
      simulation.step();
      for (const SleepEvent& event : simulation.frame().events)
        woken += event.woke && event.cause == SleepCause::check ? 1 : 0;
    }
    return woken;
  }
  /// Bodies that checks wake in a row that was disturbed again and again, once a second row lies on it.
  template <typename Disturb>
  static int checked_after(Disturb disturb) {
    auto simulation = simulation_on<Backend>(row<dimension>("[policy.adaptive]\nrings = 0\n"));
    steps(simulation, 300);
    for (int i = 0; i < 30; ++i) disturb(simulation);
    steps(simulation, 120);
    EXPECT_TRUE(simulation.world().awake().empty());
    for (int i = 0; i < 8; ++i) {
      BodyDef<dimension> cube;
      cube.pose.position = up<dimension>(1.55) + 1.1 * i * Vec<dimension>::Unit(0);
      simulation.add(cube);
    }
    return steps(simulation, 600);
  }
};

TYPED_TEST_SUITE(SleepAccount, Backends, BackendName);

TYPED_TEST(SleepAccount, ChecksBeginHoweverOftenARowWasDisturbed) {
  constexpr int dim = TypeParam::dim;
  using Run = Simulation<dim>;
  EXPECT_GT(TestFixture::checked_after([](Run&) {}), 8) << "in the undisturbed run";
  EXPECT_GT(TestFixture::checked_after([](Run& run) {
              run.thaw_all();
              TestFixture::steps(run, 40);
            }),
            8)
      << "woken by hand";
  EXPECT_GT(TestFixture::checked_after([](Run& run) {
              run.do_event(gravity<dim>(9.0));
              TestFixture::steps(run, 60);
              run.do_event(gravity<dim>(9.81));
              TestFixture::steps(run, 60);
            }),
            8)
      << "by gravity";
  EXPECT_GT(TestFixture::checked_after([](Run& run) {
              run.pull({.body = 3, .point = Vec<dim>::Zero(), .target = run.world().states().pose[3].position});
              TestFixture::steps(run, 40);
              run.release();
              TestFixture::steps(run, 20);
            }),
            8)
      << "by a pull, which keeps the bodies beside it awake";
}

/// What is done to a run at random between two steps.
template <int Dim>
void disturb(Simulation<Dim>& run, std::mt19937_64& random) {
  const auto below = [&](std::uint64_t bound) { return static_cast<int>(random() % bound); };
  const BodyStates<Dim>& states = run.world().states();
  const BodyIndex body = below(states.shape.size());
  const bool present = states.removed[body] == 0;
  switch (below(40)) {
    case 0:
      return run.thaw_all();
    case 1:
      if (present) run.remove(body);
      return;
    case 2:
      if (present) run.pull({.body = body, .point = Vec<Dim>::Zero(), .target = up<Dim>(2.0)});
      return;
    case 3:
      return run.release();
    case 4:
      return run.do_event(
          {.action = EventAction::kick, .numbers = {static_cast<double>(body)}, .velocity = up<Dim>(3.0)});
    case 5:
      return run.do_event(gravity<Dim>(1.0 + below(20)));
    case 6:
      run.add({.shape = 0, .pose = {.position = up<Dim>(8.0) + (below(16) - 8) * Vec<Dim>::Unit(0)}});
      return;
    default:
      return;
  }
}

/// The bodies that sleep, as events tell; each event must change a body.
template <int Dim>
void follow(const Frame<Dim>& frame, std::vector<std::uint8_t>& asleep) {
  asleep.resize(frame.world.states().shape.size(), 0);
  for (const SleepEvent& event : frame.events) {
    EXPECT_EQ(event.step, frame.step);
    EXPECT_NE(asleep[event.body] == 0, event.woke) << "body " << event.body << ", " << to_string(event.cause);
    asleep[event.body] = event.woke ? 0 : 1;
  }
}

template <int Dim>
void expect_agreement(const Frame<Dim>& frame, const std::vector<std::uint8_t>& asleep) {
  const BodyStates<Dim>& states = frame.world.states();
  for (BodyIndex body = 0; body < states.size(); ++body)
    if (states.removed[body] == 0) EXPECT_EQ(asleep[body], states.asleep[body]) << "body " << body;
  const auto* adaptive = dynamic_cast<const AdaptivePolicy<Dim>*>(frame.policy);
  if (adaptive != nullptr && adaptive->rules() != nullptr) EXPECT_TRUE(adaptive->rules()->sleepers().matches(states));
  EXPECT_TRUE(frame.piles.counts_match(states));
}

TYPED_TEST(SleepAccount, OfPolicyAndEventsEqualsARecountWhateverIsDone) {
  constexpr int dim = TypeParam::dim;
  const std::string tilting = "[world.gravity_motion]\nkind = \"turn\"\nspeed_deg = 3\n";
  const std::string sources = fmt::format("[[source]]\ncount = 20\nrate = 4\nposition = {}\n", vector_text<dim>(6, 8));
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const bool by_plan = seed % 2 == 0 && dim == 2;
    const std::string rings = seed > 2 ? "[policy.adaptive]\nrings = 0\n" : "";
    auto run = simulation_on<TypeParam>(row<dim>(rings + sources + obstacles<dim>() + (by_plan ? tilting : "")));
    std::mt19937_64 random(seed);
    std::vector<std::uint8_t> asleep;
    for (int step = 0; step < 720 && !::testing::Test::HasFailure(); ++step) {
      if (step > 0) disturb(run, random);  // the first step adds the row
      run.step();
      follow(run.frame(), asleep);
      expect_agreement(run.frame(), asleep);
    }
  }
}

TYPED_TEST(SleepAccount, TellsEachWakingOnceWhereTheEngineHasItsOwnRule) {
  constexpr int dim = TypeParam::dim;
  auto run = simulation_on<TypeParam>(row<dim>("", "engine"));
  Watcher<dim> watcher;
  run.add_observer(watcher);
  std::vector<std::uint8_t> asleep;
  std::size_t events = 0;
  for (int step = 0; step < 600 && !::testing::Test::HasFailure(); ++step) {
    if (step % 150 == 149) run.thaw_all();
    run.step();
    events += run.frame().events.size();
    follow(run.frame(), asleep);
    expect_agreement(run.frame(), asleep);
  }
  EXPECT_GT(events, 16U) << "the cubes fell asleep and woke";
}

/// For gravity that pulls to the side there is a wall.
TYPED_TEST(SleepAccount, AllBodiesSleepInWhateverGravityComes) {
  constexpr int dim = TypeParam::dim;
  const std::string wall = fmt::format("[[obstacle]]\nkind = \"box\"\nsize = {}\nposition = {}\n",
                                       dim == 2 ? "[1, 80]" : "[1, 80, 80]", vector_text<dim>(-10.25, 0));
  const auto all_sleep_in = [&](const Vec<dim>& gravity) {
    auto run = simulation_on<TypeParam>(row<dim>(wall));
    TestFixture::steps(run, 300);
    EXPECT_TRUE(run.world().awake().empty()) << "before";
    run.do_event({.action = EventAction::gravity, .gravity = gravity});
    TestFixture::steps(run, 1500);
    return run.world().awake().empty();
  };
  EXPECT_TRUE(all_sleep_in(-up<dim>(1.62))) << "the Moon's";
  EXPECT_TRUE(all_sleep_in(-up<dim>(25.0)));
  EXPECT_TRUE(all_sleep_in(-9.81 * Vec<dim>::Unit(0))) << "to the side";
}

}  // namespace
}  // namespace talus::sleep_account_test

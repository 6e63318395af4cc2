// Events of a scene, on every engine.

#include <fmt/format.h>

#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "tests/backends/backend.h"

namespace talus::scene_events_test {
namespace {

/// Three cubes on each other on a platform whose upper side is at a height of 2 m, and these events.
template <int Dim>
Scene<Dim> stack(const std::string& events, const std::string& policy = "adaptive") {
  const std::string text = fmt::format(
      "title = \"Stack\"\ndimension = {}\npolicy.kind = \"{}\"\n"
      "shape.cube = {{kind = \"box\", size = {}, friction = 0.8}}\nrun = {{frames = 900, until = \"rest\"}}\n"
      "pile = [{{alpha_deg = 30}}]\n"
      "[[body]]\nposition = {}\nrepeat = {}\nstep = {}\n"
      "[[obstacle]]\nname = \"platform\"\nkind = \"box\"\nsize = {}\nposition = {}\n{}",
      Dim, policy, Dim == 2 ? "[1, 1]" : "[1, 1, 1]", vector_text<Dim>(0, 2.5), Dim == 2 ? "[1, 3]" : "[1, 1, 3]",
      vector_text<Dim>(0, 1), Dim == 2 ? "[6, 0.5]" : "[6, 6, 0.5]", vector_text<Dim>(0, 1.75), events);
  return std::get<Scene<Dim>>(parse_scene(text, "text"));
}

template <typename Backend>
class SceneEvents : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;
  static void run(Simulation<dimension>& simulation) {
    while (!simulation.finished()) simulation.step();
  }
  static double height_of(const Simulation<dimension>& simulation, BodyIndex body) {
    return height<dimension>(simulation.world().states().pose[body].position);
  }
};

TYPED_TEST_SUITE(SceneEvents, Backends, BackendName);

TYPED_TEST(SceneEvents, RemoveAnObstacleAtRestAndWhatLayOnItFalls) {
  constexpr int dim = TypeParam::dim;
  for (const char* policy : {"full", "engine", "paper", "adaptive"}) {
    if (!has_policy<TypeParam>(policy)) continue;
    SCOPED_TRACE(policy);
    auto simulation = simulation_on<TypeParam>(
        stack<dim>("[[event]]\nwhen = \"rest\"\ndo = \"remove\"\nobstacle = \"platform\"\n", policy));
    TestFixture::run(simulation);
    ASSERT_EQ(simulation.done_events().size(), 1U);
    EXPECT_GT(simulation.done_events()[0].time, 0.5);
    EXPECT_TRUE(simulation.at_rest());
    EXPECT_GT(simulation.time(), simulation.done_events()[0].time + 0.5);
    EXPECT_LT(TestFixture::height_of(simulation, 0), 0.6);
  }
}

TYPED_TEST(SceneEvents, RemoveBodiesByNumberAndThoseAboveFall) {
  constexpr int dim = TypeParam::dim;
  auto simulation = simulation_on<TypeParam>(stack<dim>("[[event]]\ntime = 3\ndo = \"remove\"\nbody = 0\n"));
  run_until(simulation, 3.0);
  EXPECT_TRUE(simulation.world().awake().empty());
  TestFixture::run(simulation);
  EXPECT_EQ(simulation.world().states().removed[0], 1);
  EXPECT_LT(TestFixture::height_of(simulation, 1), 2.6);
  EXPECT_DOUBLE_EQ(simulation.done_events()[0].time, 3.0);
}

TYPED_TEST(SceneEvents, RemoveSeveralBodiesAndWakeNoneOfThem) {
  constexpr int dim = TypeParam::dim;
  auto simulation = simulation_on<TypeParam>(stack<dim>("[[event]]\ntime = 3\ndo = \"remove\"\nbody = [0, 1]\n"));
  run_until(simulation, 3.0);
  ASSERT_TRUE(simulation.world().awake().empty());
  while (simulation.time() < 3.2) {
    simulation.step();
    for (const SleepEvent& event : simulation.frame().events) EXPECT_EQ(event.body, 2);
  }
  EXPECT_EQ(simulation.done_events()[0].bodies, 2);
  EXPECT_EQ(std::vector<BodyIndex>(simulation.world().awake().begin(), simulation.world().awake().end()),
            std::vector<BodyIndex>{2});
}

TYPED_TEST(SceneEvents, MeanBodiesWithinABox) {
  constexpr int dim = TypeParam::dim;
  const std::string box =
      fmt::format("box = [{}, {}]", dim == 2 ? "[-1, 4]" : "[-1, -1, 4]", dim == 2 ? "[1, 9]" : "[1, 1, 9]");
  auto simulation = simulation_on<TypeParam>(stack<dim>("[[event]]\ntime = 1\ndo = \"remove\"\n" + box + "\n"));
  TestFixture::run(simulation);
  EXPECT_EQ(simulation.world().states().removed, (std::vector<std::uint8_t>{0, 0, 1}));
}

TYPED_TEST(SceneEvents, KickASleeper) {
  constexpr int dim = TypeParam::dim;
  const std::string kick =
      fmt::format("[[event]]\ntime = 3\ndo = \"kick\"\nbody = [2]\nvelocity = {}\n", vector_text<dim>(0, 4));
  auto simulation = simulation_on<TypeParam>(stack<dim>(kick));
  run_until(simulation, 3.0);
  ASSERT_TRUE(simulation.world().awake().empty());
  run_until(simulation, 3.3);
  EXPECT_NEAR(TestFixture::height_of(simulation, 2), 4.5 + 4 * 0.3 - 0.5 * 9.81 * 0.09, 0.1);
  EXPECT_NEAR(TestFixture::height_of(simulation, 1), 3.5, 0.05);
}

// By rounding a velocity that is cut to the fastest is longer than it in a fourth of all directions.
TYPED_TEST(SceneEvents, KickABodyBeyondTheFastestSpeedAndSpinInAnyDirection) {
  constexpr int dim = TypeParam::dim;
  auto simulation = simulation_on<TypeParam>(stack<dim>(""));
  const double fastest = fastest_speed<dim>(simulation.world().dt());
  simulation.step();
  for (int i = 1; i <= 40; ++i) {
    Event<dim> kick{.action = EventAction::kick, .numbers = {2.0}};
    kick.velocity = fastest * up<dim>(1.0) + 0.1 * i * fastest * Vec<dim>::Unit(0);
    kick.spin.setConstant(i * fastest_spin(simulation.world().dt()));
    simulation.do_event(kick);
  }
  const BodyStates<dim>& states = simulation.world().states();
  EXPECT_NEAR(states.velocity[2].norm(), fastest, 1e-6 * fastest);
  EXPECT_NEAR(states.spin[2].norm(), fastest_spin(simulation.world().dt()), 1e-6);
}

TYPED_TEST(SceneEvents, ChangeGravityForAllBodies) {
  constexpr int dim = TypeParam::dim;
  const std::string event =
      fmt::format("[[event]]\ntime = 3\ndo = \"gravity\"\ngravity = {}\n", vector_text<dim>(0, 2));
  auto simulation = simulation_on<TypeParam>(stack<dim>(event));
  run_until(simulation, 4.0);
  for (const BodyIndex body : {0, 1, 2})
    EXPECT_NEAR(TestFixture::height_of(simulation, body), 2.5 + body + 0.5 * 2.0, 0.1) << body;
}

TYPED_TEST(SceneEvents, WaitForALayerToBeDense) {
  constexpr int dim = TypeParam::dim;
  const std::string more = fmt::format(
      "[[source]]\nposition = {}\ncount = 40\nrate = 5\nvelocity = {}\n"
      "[[event]]\nwhen = \"layer_density\"\ndensity = 0.3\ndo = \"wake\"\n"
      "[[event]]\nwhen = \"layer_density\"\ndensity = 900\ndo = \"wake\"\n",
      vector_text<dim>(20, 12), vector_text<dim>(0, -10));
  for (const char* policy : {"full", "adaptive"}) {
    SCOPED_TRACE(policy);
    auto simulation = simulation_on<TypeParam>(stack<dim>(more, policy));
    double densest_before = 0.0;
    while (simulation.done_events().empty() && simulation.time() < 12.0) {
      densest_before = 0.0;
      for (const auto& pile : simulation.piles().piles())
        for (const Layer& layer : pile.layers) densest_before = std::max(densest_before, layer.density());
      simulation.step();
    }
    ASSERT_EQ(simulation.done_events().size(), 1U);
    EXPECT_EQ(simulation.done_events()[0].number, 0);
    EXPECT_GT(densest_before, 0.3);
  }
}

TYPED_TEST(SceneEvents, SwitchThePolicyAndBack) {
  constexpr int dim = TypeParam::dim;
  auto simulation =
      simulation_on<TypeParam>(stack<dim>("[[event]]\ntime = 2\ndo = \"policy\"\npolicy = \"adaptive\"\n"
                                          "[[event]]\ntime = 5\ndo = \"policy\"\npolicy = \"full\"\n",
                                          "full"));
  run_until(simulation, 2.0);
  EXPECT_EQ(simulation.world().awake().size(), 3U);
  run_until(simulation, 5.0);
  EXPECT_TRUE(simulation.world().awake().empty());
  run_until(simulation, 6.0);
  EXPECT_EQ(simulation.world().awake().size(), 3U);
}

TYPED_TEST(SceneEvents, ChangeTheRateOfASource) {
  constexpr int dim = TypeParam::dim;
  const std::string text =
      stack<dim>("").toml + fmt::format(
                                "[[source]]\nposition = {}\nvelocity = {}\ncount = 10\nrate = 0.01\n"
                                "[[event]]\nbodies = 4\ndo = \"rate\"\nrate = 5\n",
                                vector_text<dim>(-20, 20), vector_text<dim>(0, -12));
  auto simulation = simulation_on<TypeParam>(std::get<Scene<dim>>(parse_scene(text, "text")));
  run_until(simulation, 4.0);
  EXPECT_EQ(simulation.emitter().emitted(), 13);
}

TYPED_TEST(SceneEvents, WaitForOneRestEach) {
  constexpr int dim = TypeParam::dim;
  auto simulation = simulation_on<TypeParam>(
      stack<dim>("[[event]]\nwhen = \"rest\"\ndo = \"wake\"\n[[event]]\nwhen = \"rest\"\ndo = \"picture\"\n"));
  TestFixture::run(simulation);
  ASSERT_EQ(simulation.done_events().size(), 2U);
  EXPECT_GT(simulation.done_events()[1].time, simulation.done_events()[0].time + 0.5);
}

}  // namespace
}  // namespace talus::scene_events_test

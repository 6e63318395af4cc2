// Bodies that are in the world from the start, on every engine.

#include <fmt/format.h>

#include "common/policy/observer.h"
#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "common/simulation/state_hash.h"
#include "tests/backends/backend.h"

namespace talus::initial_bodies_test {
namespace {

template <int Dim>
struct EventCounter final : Observer<Dim> {
  void on_frame(const Frame<Dim>& frame) override { events += std::ssize(frame.events); }
  std::int64_t events = 0;
};

/// A wall of 4 x 5 bricks, or as many layers of 4 x 2 in space, and what `rest` adds to its table.
template <int Dim>
Scene<Dim> wall(const std::string& rest, const std::string& policy) {
  const std::string text = fmt::format(
      "title = \"Wall\"\ndimension = {}\npolicy.kind = \"{}\"\nshape.brick = {{kind = \"box\", size = {}}}\n"
      "[[body]]\nposition = {}\nrepeat = {}\nstep = {}\nstagger = {}\n{}\n",
      Dim, policy, Dim == 2 ? "[1, 0.5]" : "[1, 0.5, 0.5]", Dim == 2 ? "[0, 0.25]" : "[0, 0, 0.25]",
      Dim == 2 ? "[4, 5]" : "[4, 2, 5]", Dim == 2 ? "[1, 0.5]" : "[1, 0.5, 0.5]",
      Dim == 2 ? "[0.25, 0]" : "[0.25, 0, 0]", rest);
  return std::get<Scene<Dim>>(parse_scene(text, "text"));
}

template <typename Backend>
class InitialBodies : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;
};

TYPED_TEST_SUITE(InitialBodies, Backends, BackendName);

TYPED_TEST(InitialBodies, OfAWallStandWhereTheyWerePut) {
  constexpr int dim = TypeParam::dim;
  for (const char* policy : {"full", "adaptive", "engine"}) {
    if (!has_policy<TypeParam>(policy)) continue;
    SCOPED_TRACE(policy);
    const Scene<dim> scene = wall<dim>("", policy);
    auto simulation = simulation_on<TypeParam>(scene);
    EventCounter<dim> observer;
    simulation.add_observer(observer);
    for (int i = 0; i < 180; ++i) simulation.step();
    simulation.end("finished");
    const BodyStates<dim>& states = simulation.world().states();
    ASSERT_EQ(states.size(), static_cast<BodyIndex>(scene.bodies.size()));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      EXPECT_LT((states.pose[i].position - scene.bodies[i].def.pose.position).norm(), 0.12) << i;
    EXPECT_TRUE(simulation.emitter().finished());
    EXPECT_EQ(simulation.frame().bodies_planned, std::ssize(scene.bodies));
    EXPECT_TRUE(simulation.warnings().empty());
  }
}

TYPED_TEST(InitialBodies, ThatAreAsleepCostNothingUntilSomethingHitsThem) {
  constexpr int dim = TypeParam::dim;
  Scene<dim> scene = wall<dim>("asleep = true", "adaptive");
  auto still = simulation_on<TypeParam>(scene);
  EventCounter<dim> observer;
  still.add_observer(observer);
  for (int i = 0; i < 30; ++i) still.step();
  EXPECT_TRUE(still.world().awake().empty());
  EXPECT_EQ(observer.events, std::ssize(scene.bodies)) << "each fell asleep once";
  BodyDef<dim> ball;
  ball.pose.position = Vec<dim>::Unit(0) * -8.0 + up<dim>(1.0);
  ball.velocity[0] = 30.0;
  scene.bodies.push_back({ball, false});
  auto hit = simulation_on<TypeParam>(scene);
  std::size_t most_awake = 0;
  for (int i = 0; i < 60; ++i) {
    hit.step();
    most_awake = std::max(most_awake, hit.world().awake().size());
  }
  EXPECT_GT(most_awake, 4U);
}

TYPED_TEST(InitialBodies, ThatAreAsleepFollowTheEventsOfTheStart) {
  constexpr int dim = TypeParam::dim;
  const auto top = static_cast<BodyIndex>(wall<dim>("", "adaptive").bodies.size() - 1);
  auto simulation = simulation_on<TypeParam>(
      wall<dim>(fmt::format("asleep = true\n[[event]]\ntime = 0\ndo = \"kick\"\nbody = {}\nvelocity = {}\n"
                            "[[event]]\ntime = 0\ndo = \"remove\"\nbody = {}",
                            top, vector_text<dim>(0, 3), top - 1),
                "adaptive"));
  for (int i = 0; i < 6; ++i) simulation.step();
  EXPECT_NEAR(height<dim>(simulation.world().states().velocity[top]), 3.0 - 0.1 * 9.81, 0.05);
  EXPECT_EQ(simulation.world().states().removed[top - 1], 1);
}

TYPED_TEST(InitialBodies, AreAwakeUnderPoliciesThatPutNoneToSleep) {
  constexpr int dim = TypeParam::dim;
  auto simulation = simulation_on<TypeParam>(wall<dim>("asleep = true", "full"));
  simulation.step();
  EXPECT_EQ(simulation.world().awake().size(), simulation.world().states().shape.size());
}

TYPED_TEST(InitialBodies, GiveTheSameBitsInEachRun) {
  constexpr int dim = TypeParam::dim;
  const auto hash = [] {
    auto simulation = simulation_on<TypeParam>(wall<dim>("", "adaptive"));
    for (int i = 0; i < 60; ++i) simulation.step();
    return state_hash(simulation.world().states());
  };
  EXPECT_EQ(hash(), hash());
}

TYPED_TEST(InitialBodies, OfAGridOfOneRotationMayTouch) {
  constexpr int dim = TypeParam::dim;
  const std::string text = fmt::format(
      "title = \"Grid\"\ndimension = {}\nshape.brick = {{kind = \"box\", size = {}}}\n[[source]]\ncount = {}\n"
      "grid = {}\nspacing = {}\nangle_deg = 0\n{}\n",
      dim, dim == 2 ? "[0.7, 0.3]" : "[0.7, 0.3, 0.3]", dim == 2 ? 30 : 60, dim == 2 ? "[10, 3]" : "[5, 4, 3]",
      dim == 2 ? "[0.7, 0.3]" : "[0.7, 0.3, 0.3]", dim == 2 ? "" : "axis = [0, 0, 1]");
  auto simulation = simulation_on<TypeParam>(std::get<Scene<dim>>(parse_scene(text, "text")));
  simulation.step();
  EXPECT_TRUE(simulation.emitter().finished());
}

}  // namespace
}  // namespace talus::initial_bodies_test

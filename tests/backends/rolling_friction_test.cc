// Rolling friction against closed forms, on every engine.

#include <fmt/format.h>

#include <cmath>

#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "tests/backends/backend.h"

namespace talus::rolling_friction_test {
namespace {

/// A ball of radius 0.5 m on the ground with this rolling friction and what `rest` adds.
template <int Dim>
Scene<Dim> ball(double rolling_friction, const std::string& policy, const std::string& rest) {
  const std::string text = fmt::format(
      "title = \"Ball\"\ndimension = {}\npolicy.kind = \"{}\"\n"
      "shape.ball = {{kind = \"ball\", radius = 0.5, friction = 0.8, rolling_friction = {}}}\n{}\n",
      Dim, policy, rolling_friction, rest);
  return std::get<Scene<Dim>>(parse_scene(text, "text"));
}

template <typename Backend>
class RollingFriction : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;
  /// After so many seconds.
  static Simulation<dimension> run(const Scene<dimension>& scene, double seconds) {
    auto simulation = simulation_on<Backend>(scene);
    run_until(simulation, seconds);
    return simulation;
  }
};

TYPED_TEST_SUITE(RollingFriction, SmallStepsBackends, BackendName);

/// Work of the resisting torque against the energy of a rolling ball, v^2 (1 + k) / 2 of unit mass with an inertia of
/// k r^2: it stops after v^2 (1 + k) / (2 mu g).
TYPED_TEST(RollingFriction, StopsABallAfterTheDistanceOfTheClosedForm) {
  constexpr int dim = TypeParam::dim;
  for (const double coefficient : {0.02, 0.1}) {
    SCOPED_TRACE(coefficient);
    const double speed = 2.0;
    const double spin = speed / 0.5;  // clockwise
    const std::string body =
        fmt::format("body = [{{position = {}, velocity = {}, spin = {}}}]", vector_text<dim>(0, 0.5),
                    vector_text<dim>(speed, 0), dim == 2 ? fmt::format("{}", -spin) : fmt::format("[0, {}, 0]", spin));
    const double share = dim == 2 ? 0.5 : 0.4;
    const double distance = speed * speed * (1.0 + share) / (2.0 * coefficient * 9.81);
    const double time = 2.0 * distance / speed;
    const auto simulation = TestFixture::run(ball<dim>(coefficient, "full", body), time + 1.0);
    const Vec<dim> end = simulation.world().states().pose[0].position;
    EXPECT_NEAR(end[0], distance, 0.02 * distance + 0.02);
    EXPECT_LT(simulation.world().states().velocity[0].norm(), 1e-3);
  }
}

TYPED_TEST(RollingFriction, HoldsABallOnASlopeUpToItsTangent) {
  constexpr int dim = TypeParam::dim;
  for (const double degrees : {5.0, 7.0}) {  // atan(0.1) is 5.7 degrees
    SCOPED_TRACE(degrees);
    const std::string gravity =
        vector_text<dim>(9.81 * std::sin(in_radians(degrees)), -9.81 * std::cos(in_radians(degrees)));
    const auto simulation = TestFixture::run(
        ball<dim>(0.1, "full",
                  fmt::format("world.gravity = {}\nbody = [{{position = {}}}]", gravity, vector_text<dim>(0, 0.5))),
        5.0);
    const double way = simulation.world().states().pose[0].position[0];
    if (degrees < 5.7)
      EXPECT_LT(way, 0.05);
    else
      EXPECT_GT(way, 1.0);
  }
}

TYPED_TEST(RollingFriction, LetsAHeapOfBallsComeToRestUnderEachPolicy) {
  constexpr int dim = TypeParam::dim;
  const std::string heap = fmt::format(
      "run = {{until = \"rest\", frames = 1500}}\n"
      "source = [{{count = 40, position = {}, velocity = {}}}]\npile = [{{}}]",
      vector_text<dim>(0, 10), vector_text<dim>(0, -8));
  for (const char* policy : {"full", "adaptive"}) {
    SCOPED_TRACE(policy);
    const Scene<dim> scene = ball<dim>(0.2, policy, heap);
    auto simulation = simulation_on<TypeParam>(scene);
    while (!simulation.finished()) simulation.step();
    EXPECT_TRUE(simulation.at_rest()) << simulation.time();
  }
}

/// Bodies with flat sides touch with several points and pieces at once. A run warns of energy that its steps create.
TYPED_TEST(RollingFriction, OfBodiesWithFlatSidesCreatesNoEnergy) {
  constexpr int dim = TypeParam::dim;
  for (const int seed : {1, 2, 3, 4}) {
    const auto scene = std::get<Scene<dim>>(parse_scene(
        fmt::format("title = \"L\"\ndimension = {}\nseed = {}\npolicy.kind = \"full\"\n"
                    "shape.L = {{kind = \"L\", friction = 3.6, rolling_friction = 3}}\nground.friction = 3.6\n"
                    "source = [{{count = 60, rate = 6.6, position = {}, velocity = {}}}]\n",
                    dim, seed, vector_text<dim>(0, 8), vector_text<dim>(0, -10)),
        "text"));
    auto simulation = simulation_on<TypeParam>(scene);
    Watcher<dim> watcher;
    simulation.add_observer(watcher);
    run_until(simulation, 12.0);
    for (const Warning& warning : simulation.warnings()) ADD_FAILURE() << "seed " << seed << ": " << account(warning);
  }
}

TYPED_TEST(RollingFriction, OfASleepingBallIsThatOfAnAwakeOne) {
  constexpr int dim = TypeParam::dim;
  const std::string heap =
      fmt::format("run = {{frames = 900}}\nsource = [{{count = 30, position = {}, velocity = {}}}]\npile = [{{}}]",
                  vector_text<dim>(0, 10), vector_text<dim>(0, -8));
  auto simulation = TestFixture::run(ball<dim>(0.1, "adaptive", heap), 25.0);
  EXPECT_LT(simulation.world().awake().size(), 3U);
  simulation.thaw_all();
  const auto before = simulation.world().states().pose;
  for (int i = 0; i < 120; ++i) simulation.step();
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LT((simulation.world().states().pose[i].position - before[i].position).norm(), 0.1) << i;
}

}  // namespace
}  // namespace talus::rolling_friction_test

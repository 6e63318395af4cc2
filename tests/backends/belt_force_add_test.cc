// Belts, forces on bodies, and what events add, on every engine.

#include <fmt/format.h>

#include "common/scene/diagnostics.h"
#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "common/simulation/watchdog.h"
#include "tests/backends/backend.h"

namespace talus::belt_force_add_test {
namespace {

constexpr double friction = 0.5;
constexpr double gravity = 9.81;

template <int Dim>
std::string box(double x, double z) {
  return Dim == 2 ? fmt::format("[{}, {}]", x, z) : fmt::format("[{}, 1, {}]", x, z);
}

template <int Dim>
Scene<Dim> scene_of(const std::string& rest, const std::string& policy = "adaptive") {
  return std::get<Scene<Dim>>(
      parse_scene(fmt::format("title = \"Text\"\ndimension = {}\npolicy.kind = \"{}\"\nground.friction = {}\n"
                              "shape.box = {{kind = \"box\", size = {}, friction = {}}}\nrun = {{frames = 9000}}\n{}",
                              Dim, policy, friction, box<Dim>(1.0, 0.5), friction, rest),
                  "text"));
}

/// A box on a belt of 40 m whose upper side is at 0.5 m.
template <int Dim>
std::string on_belt(double speed, const std::string& more = "") {
  return fmt::format(
      "body = [{{position = {}}}]\n[[obstacle]]\nkind = \"box\"\nsize = {}\nposition = {}\nfriction = {}\n"
      "motion = {{kind = \"belt\", surface_velocity = {}{}}}\n",
      vector_text<Dim>(0.0, 0.751), box<Dim>(40.0, 0.5), vector_text<Dim>(0.0, 0.25), friction,
      vector_text<Dim>(speed, 0.0), more);
}

template <typename Backend>
class OnEachEngine : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;
  static Vec<dimension> place(const Simulation<dimension>& simulation) {
    return simulation.world().states().pose[0].position;
  }
  static double speed(const Simulation<dimension>& simulation) {
    return simulation.world().states().velocity[0].norm();
  }
};

template <typename Backend>
using Belt = OnEachEngine<Backend>;
TYPED_TEST_SUITE(Belt, SmallStepsBackends, BackendName);

// v = mu g t until the box is as fast as the belt, t = v / (mu g) = 0.41 s; it lags behind by v^2 / (2 mu g) = 0.41 m.
TYPED_TEST(Belt, DragsABoxByFrictionUpToItsOwnSpeed) {
  constexpr int dim = TypeParam::dim;
  constexpr double belt = 2.0;
  for (const char* policy : {"full", "adaptive"}) {
    SCOPED_TRACE(policy);
    auto simulation = simulation_on<TypeParam>(scene_of<dim>(on_belt<dim>(belt, ", start = 1"), policy));
    run_until(simulation, 1.0);
    EXPECT_NEAR(TestFixture::place(simulation)[0], 0.0, 0.005);
    run_until(simulation, 1.2);
    EXPECT_NEAR(TestFixture::speed(simulation), friction * gravity * 0.2, 0.1);
    run_until(simulation, 4.0);
    EXPECT_NEAR(TestFixture::speed(simulation), belt, 0.05);
    EXPECT_NEAR(TestFixture::place(simulation)[0], 3.0 * belt - belt * belt / (2.0 * friction * gravity), 0.05);
    EXPECT_EQ(simulation.world().obstacle_pose(0).position,
              scene_of<dim>(on_belt<dim>(belt)).world.obstacles[0].pose.position);
  }
}

TYPED_TEST(Belt, LetsItsBodySleepBeforeItRunsAndAfter) {
  constexpr int dim = TypeParam::dim;
  auto simulation = simulation_on<TypeParam>(scene_of<dim>(on_belt<dim>(1.0, ", start = 3, end = 5")));
  run_until(simulation, 3.0);
  EXPECT_TRUE(simulation.world().awake().empty());
  run_until(simulation, 4.9);
  EXPECT_EQ(simulation.world().awake().size(), 1U);
  run_until(simulation, 8.0);
  EXPECT_TRUE(simulation.world().awake().empty());
}

TYPED_TEST(Belt, DoesNotPushWhatStandsAtItsEnd) {
  constexpr int dim = TypeParam::dim;
  std::string text = on_belt<dim>(2.0);
  text.replace(text.find(vector_text<dim>(0.0, 0.751)), vector_text<dim>(0.0, 0.751).size(),
               vector_text<dim>(20.502, 0.251));
  auto simulation = simulation_on<TypeParam>(scene_of<dim>(text, "full"));
  run_until(simulation, 2.0);
  EXPECT_NEAR(TestFixture::place(simulation)[0], 20.502, 0.01);
}

TYPED_TEST(Belt, CreatesNoEnergyInTheAccount) {
  constexpr int dim = TypeParam::dim;
  const Scene<dim> scene = scene_of<dim>(on_belt<dim>(5.0), "full");
  auto simulation = simulation_on<TypeParam>(scene);
  Watcher<dim> watcher;
  simulation.add_observer(watcher);
  run_until(simulation, 3.0);
  EXPECT_GT(TestFixture::speed(simulation), 4.9);
  EXPECT_TRUE(simulation.warnings().empty());
}

template <typename Backend>
using Force = OnEachEngine<Backend>;
TYPED_TEST_SUITE(Force, SmallStepsBackends, BackendName);

template <int Dim>
std::string pushed(double share_of_weight, const std::string& more = "") {
  const double mass =
      scene_of<Dim>(fmt::format("body = [{{position = {}}}]\n", vector_text<Dim>(0.0, 0.251))).world.shapes[0].mass;
  return fmt::format("body = [{{position = {}}}]\n[[event]]\ntime = 2\ndo = \"force\"\nforce = {}\n{}",
                     vector_text<Dim>(0.0, 0.251), vector_text<Dim>(share_of_weight * mass * gravity, 0.0), more);
}

TYPED_TEST(Force, BelowTheLimitOfFrictionMovesNothing) {
  constexpr int dim = TypeParam::dim;
  auto simulation = simulation_on<TypeParam>(scene_of<dim>(pushed<dim>(0.9 * friction)));
  run_until(simulation, 5.0);
  EXPECT_NEAR(TestFixture::place(simulation)[0], 0.0, 0.01);
}

// In the air a tenth of a second with the body's weight gives a tenth of g, whichever steps these are.
TYPED_TEST(Force, ActsForItsTimeToTheStep) {
  constexpr int dim = TypeParam::dim;
  for (int first = 1; first <= 60; ++first) {
    Scene<dim> scene = scene_of<dim>(pushed<dim>(1.0, "seconds = 0.1\n"));
    scene.bodies[0].def.pose.position[dim - 1] = 50.0;
    scene.events[0].time = first * scene.world.dt;
    auto simulation = simulation_on<TypeParam>(scene);
    for (int step = 0; step < first + 20; ++step) simulation.step();
    EXPECT_NEAR(simulation.world().states().velocity[0][0], 0.1 * gravity, 1e-3) << first;
  }
}

// With 0.3 g beyond friction, x = 0.3 g t^2 / 2 for one second, then it slides on until friction has stopped it.
// Friction is right to 3 % on the engines, which is 5 % of the difference.
TYPED_TEST(Force, AboveItAcceleratesForItsTime) {
  constexpr int dim = TypeParam::dim;
  auto simulation = simulation_on<TypeParam>(scene_of<dim>(pushed<dim>(friction + 0.3, "seconds = 1\n")));
  run_until(simulation, 3.0);
  const double speed = 0.3 * gravity;
  EXPECT_NEAR(TestFixture::place(simulation)[0], 0.5 * speed, 0.05 * speed);
  EXPECT_NEAR(TestFixture::speed(simulation), speed, 0.05 * speed);
  run_until(simulation, 6.0);
  EXPECT_NEAR(TestFixture::place(simulation)[0], 0.5 * speed + speed * speed / (2.0 * friction * gravity), 0.2);
  EXPECT_TRUE(simulation.world().awake().empty());
}

TYPED_TEST(Force, OfSomeSecondsEndsBeforeARunEndsAtRest) {
  constexpr int dim = TypeParam::dim;
  Scene<dim> scene = scene_of<dim>(pushed<dim>(0.5 * friction, "seconds = 5\n"));
  scene.run.until = until_rest;
  auto simulation = simulation_on<TypeParam>(scene);
  while (!simulation.finished()) simulation.step();
  EXPECT_TRUE(simulation.at_rest());
  EXPECT_GT(simulation.time(), 7.0);
}

TYPED_TEST(Force, CreatesNoEnergyInTheAccount) {
  constexpr int dim = TypeParam::dim;
  auto simulation = simulation_on<TypeParam>(scene_of<dim>(pushed<dim>(3.0), "full"));
  Watcher<dim> watcher;
  simulation.add_observer(watcher);
  run_until(simulation, 4.0);
  EXPECT_GT(TestFixture::speed(simulation), 20.0);
  EXPECT_TRUE(simulation.warnings().empty());
}

TYPED_TEST(Force, EndsWithTheBodyAndWithItsSleep) {
  constexpr int dim = TypeParam::dim;
  const auto world = TypeParam::make(scene_of<dim>(pushed<dim>(0.0)).world);
  std::vector<BodyIndex> bodies;
  for (const double x : {-3.0, 0.0, 3.0}) {
    BodyDef<dim> box;
    box.pose.position[0] = x;
    box.pose.position[dim - 1] = 0.251;
    bodies.push_back(world->add(box));
  }
  world->step();
  const Vec<dim> force = 10.0 * Vec<dim>::Unit(dim - 1);
  for (const BodyIndex body : bodies) world->push(body, force);
  world->freeze(std::span(bodies).first(1));
  world->remove(bodies[1]);
  ASSERT_EQ(world->pushes().size(), 1U);
  EXPECT_EQ(world->pushes()[0].body, bodies[2]);
  world->step();
  EXPECT_TRUE(world->pushes().empty());
}

// Two boxes are pressed against both sides of a third with twice what their friction needs to hold it.
TYPED_TEST(Force, OfAGripperHoldsABodyInTheAir) {
  constexpr int dim = TypeParam::dim;
  const Scene<dim> one = scene_of<dim>(fmt::format("body = [{{position = {}}}]\n", vector_text<dim>(0.0, 5.0)));
  const double press = 2.0 * one.world.shapes[0].mass * gravity / (2.0 * friction);
  const std::string jaw = "[[obstacle]]\nkind = \"box\"\nsize = {}\nposition = {}\n";
  std::string text =
      fmt::format("shape.jaw = {{kind = \"box\", size = {}, friction = {}}}\n", box<dim>(0.5, 0.5), friction);
  for (const double x : {0.0, -0.751, 0.751})
    text +=
        fmt::format("[[body]]\nshape = \"{}\"\nposition = {}\n", x == 0.0 ? "box" : "jaw", vector_text<dim>(x, 5.251));
  // The jaws stand on columns, the body in the middle on a lid that is taken away.
  for (const double x : {-0.86, 0.86})
    text += fmt::vformat(jaw, fmt::make_format_args(box<dim>(0.6, 5.0), vector_text<dim>(x, 2.5)));
  text +=
      fmt::vformat(jaw, fmt::make_format_args(box<dim>(0.9, 0.5), vector_text<dim>(0.0, 4.75))) + "name = \"lid\"\n";
  for (const int body : {1, 2})
    text += fmt::format("[[event]]\ntime = 0\ndo = \"force\"\nbody = {}\nforce = {}\n", body,
                        vector_text<dim>(body == 1 ? press : -press, 0.0));
  text += "[[event]]\ntime = 2\ndo = \"remove\"\nobstacle = \"lid\"\n";
  auto simulation = simulation_on<TypeParam>(scene_of<dim>(text));
  run_until(simulation, 4.0);
  EXPECT_NEAR(height<dim>(TestFixture::place(simulation)), 5.25, 0.02);
}

template <typename Backend>
using Adding = OnEachEngine<Backend>;
TYPED_TEST_SUITE(Adding, Backends, BackendName);

TYPED_TEST(Adding, OfAnObstacleByAnEventStopsWhatFallsLater) {
  constexpr int dim = TypeParam::dim;
  const std::string text = fmt::format(
      "source = [{{count = 2, rate = 0.5, position = {}, spread = {}, {}}}]\n"
      "[[obstacle]]\nname = \"lid\"\nkind = \"box\"\nsize = {}\nposition = {}\n"
      "[[event]]\ntime = 1.9\ndo = \"add\"\nobstacle = \"lid\"\n",
      vector_text<dim>(0.0, 4.0), dim == 2 ? "[0, 0]" : "[0, 0, 0]",
      dim == 2 ? "angle_deg = 0" : "angle_deg = 0, axis = [0, 0, 1]", box<dim>(5.0, 0.5), vector_text<dim>(0.0, 2.0));
  for (const char* policy : {"full", "adaptive"}) {
    SCOPED_TRACE(policy);
    auto simulation = simulation_on<TypeParam>(scene_of<dim>(text, policy));
    run_until(simulation, 1.5);
    EXPECT_FALSE(simulation.world().has_obstacle(0));
    run_until(simulation, 6.0);
    EXPECT_TRUE(simulation.world().has_obstacle(0));
    EXPECT_NEAR(height<dim>(simulation.world().states().pose[0].position), 0.25, 0.03);
    EXPECT_NEAR(height<dim>(simulation.world().states().pose[1].position), 2.5, 0.03);
  }
}

TYPED_TEST(Adding, OfABodyOnceTheWorldRestsEndsTheRunAfterIt) {
  constexpr int dim = TypeParam::dim;
  const std::string text = fmt::format(
      "body = [{{position = {}}}]\nsource = [{{count = 1, position = {}}}]\n"
      "[[event]]\nwhen = \"rest\"\ndo = \"add\"\nsource = 0\n",
      vector_text<dim>(0.0, 0.251), vector_text<dim>(3.0, 4.0));
  auto scene = scene_of<dim>(text);
  scene.run.until = until_rest;
  auto simulation = simulation_on<TypeParam>(scene);
  while (!simulation.finished() && simulation.time() < 60.0) simulation.step();
  EXPECT_TRUE(simulation.at_rest());
  ASSERT_EQ(simulation.world().states().size(), 2);
  ASSERT_EQ(simulation.done_events().size(), 1U);
  EXPECT_LT(height<dim>(simulation.world().states().pose[1].position), 1.0);
}

}  // namespace
}  // namespace talus::belt_force_add_test

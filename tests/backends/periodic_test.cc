// Periodic sides, on every engine with the common solver.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "common/measure/gate_counter.h"
#include "common/measure/region_meter.h"
#include "common/measure/support.h"
#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "common/world/scaled_world.h"
#include "tests/backends/backend.h"

namespace talus::periodic_test {
namespace {

constexpr double gravity = 9.81;

/// A world of 10 m from -5 to 5; in 3D of 8 m from -4 to 4 along y too.
template <int Dim>
Scene<Dim> scene_of(const std::string& world, const std::string& rest, const std::string& policy = "full") {
  return std::get<Scene<Dim>>(
      parse_scene(fmt::format("title = \"Text\"\ndimension = {}\npolicy.kind = \"{}\"\nrun = {{frames = 9000}}\n"
                              "world = {{periodic_x = [-5, 5]{}{}}}\n{}",
                              Dim, policy, Dim == 3 ? ", periodic_y = [-4, 4]" : "", world, rest),
                  "text"));
}

template <int Dim>
const std::string ball = "shape.ball = {kind = \"ball\", radius = 0.5, friction = 0.5}\n";
template <int Dim>
std::string box(const std::string& more = "") {
  return fmt::format("shape.box = {{kind = \"box\", size = {}, friction = 0.5{}}}\n",
                     Dim == 2 ? "[1, 0.5]" : "[1, 1, 0.5]", more);
}

template <typename Backend>
class Sides : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;
  static const BodyStates<dimension>& states(const Simulation<dimension>& simulation) {
    return simulation.world().states();
  }
};
TYPED_TEST_SUITE(Sides, SmallStepsBackends, BackendName);

// Two balls fly apart, meet behind the sides and exchange their velocities, since restitution is 1.
TYPED_TEST(Sides, LetTwoBallsCollideThroughThem) {
  constexpr int dim = TypeParam::dim;
  std::string text =
      "ground.present = false\nshape.ball = {kind = \"ball\", radius = 0.5, friction = 0, restitution = 1}\n";
  for (const double side : {-1.0, 1.0})
    text += fmt::format("[[body]]\nposition = {}\nvelocity = {}\n", vector_text<dim>(2.0 * side, 0.0),
                        vector_text<dim>(4.0 * side, 0.0));
  auto simulation = simulation_on<TypeParam>(scene_of<dim>(", gravity = 0", text));
  run_until(simulation, 1.0);  // they have met 0.625 s after the start, 4.5 m from the middle
  const auto& states = TestFixture::states(simulation);
  for (const int body : {0, 1}) {
    const double side = body == 0 ? -1.0 : 1.0;
    EXPECT_NEAR(states.velocity[body][0], -4.0 * side, 0.01);
    EXPECT_NEAR(states.pose[body].position[0], side * (4.5 - 4.0 * 0.375), 0.14);  // two steps
  }
}

// v = g (sin a - mu cos a) t, whatever number of sides it has gone through: here 3 or 4.
TYPED_TEST(Sides, LetASlidingBoxGoOnAndCreateNoEnergy) {
  constexpr int dim = TypeParam::dim;
  const double angle = 35.0 * std::numbers::pi / 180.0;
  auto simulation = simulation_on<TypeParam>(scene_of<dim>(
      fmt::format(", gravity = {}", vector_text<dim>(gravity * std::sin(angle), -gravity * std::cos(angle))),
      "ground.friction = 0.5\n" + box<dim>() + "[[body]]\nposition = " + vector_text<dim>(0.0, 0.251) + "\n"));
  Watcher<dim> watcher;
  simulation.add_observer(watcher);
  constexpr double time = 6.0;
  run_until(simulation, time);
  const double acceleration = gravity * (std::sin(angle) - 0.5 * std::cos(angle));
  EXPECT_NEAR(TestFixture::states(simulation).velocity[0][0], acceleration * time, 0.03 * acceleration * time);
  // On planar Bullet a fast box runs 1.5 cm deep, in an open world too.
  EXPECT_NEAR(TestFixture::states(simulation).pose[0].position[dim - 1], 0.25, 0.02);
  EXPECT_LE(std::abs(TestFixture::states(simulation).pose[0].position[0]), 5.01);
  EXPECT_TRUE(simulation.warnings().empty());
}

// Three boxes make a bridge: two that stand near the sides, and one over the gap between them, which is at the sides.
// Then a box falls onto the sleeping bridge.
TYPED_TEST(Sides, CarryABridgeAcrossThemAwakeAndAsleep) {
  constexpr int dim = TypeParam::dim;
  for (const char* policy : {"full", "adaptive"}) {
    SCOPED_TRACE(policy);
    std::string text = "ground.friction = 0.5\n" + box<dim>();
    for (const auto& [x, z] : {std::pair(4.3, 0.251), std::pair(-4.3, 0.251), std::pair(-4.99, 0.753)})
      text += fmt::format("[[body]]\nposition = {}\n", vector_text<dim>(x, z));
    text += fmt::format("[[source]]\nposition = {}\nstart = 4\ncount = 1\nspread = {}\nspin_spread = 0\n{}\n",
                        vector_text<dim>(5.0, 1.5), dim == 2 ? "[0, 0]" : "[0, 0, 0]",
                        dim == 2 ? "angle_deg = 0" : "angle_deg = 0\naxis = [0, 0, 1]");
    auto simulation = simulation_on<TypeParam>(scene_of<dim>("", text, policy));
    run_until(simulation, 3.9);
    EXPECT_EQ(simulation.world().awake().empty(), std::string(policy) == "adaptive");
    EXPECT_NEAR(TestFixture::states(simulation).pose[2].position[dim - 1], 0.75, 0.01);
    run_until(simulation, 12.0);
    ASSERT_EQ(TestFixture::states(simulation).size(), 4);
    EXPECT_NEAR(TestFixture::states(simulation).pose[3].position[dim - 1], 1.25, 0.01);
    EXPECT_EQ(simulation.world().awake().empty(), std::string(policy) == "adaptive");
  }
}

// The bridge's contacts are found by their geometry too: else all of it would float.
TYPED_TEST(Sides, AreKnownToTheMeasureOfSupport) {
  constexpr int dim = TypeParam::dim;
  std::string text = "ground.friction = 0.5\n" + box<dim>();
  for (const auto& [x, z] : {std::pair(4.3, 0.251), std::pair(-4.99, 0.753)})
    text += fmt::format("[[body]]\nposition = {}\n", vector_text<dim>(x, z));
  const Scene<dim> scene = scene_of<dim>("", text);
  auto simulation = simulation_on<TypeParam>(scene);
  simulation.step();
  BodyStates<dim> states = TestFixture::states(simulation);
  states.asleep.assign(2, 1);
  const auto touches = touching_pairs(scene.world, states, 0.01);
  EXPECT_EQ(touches.size(), 2U);
  EXPECT_TRUE(floating_sleepers(states, std::span(touches)).empty());
}

// A floor of one obstacle over the upper side carries at the lower side too.
TYPED_TEST(Sides, RepeatObstacles) {
  constexpr int dim = TypeParam::dim;
  const std::string text =
      "ground.present = false\n" + box<dim>() +
      fmt::format("[[obstacle]]\nkind = \"box\"\nsize = {}\nposition = {}\n[[body]]\nposition = {}\n",
                  dim == 2 ? "[2, 1]" : "[2, 2, 1]", vector_text<dim>(5.0, 0.0), vector_text<dim>(-4.5, 1.0));
  auto simulation = simulation_on<TypeParam>(scene_of<dim>("", text, "adaptive"));
  run_until(simulation, 3.0);
  EXPECT_NEAR(TestFixture::states(simulation).pose[0].position[dim - 1], 0.75, 0.01);
  EXPECT_TRUE(simulation.world().awake().empty());
}

// A box 1 m wide at x = -4.9, which is at 5.1 too, reaches 0.4 m to the left of the sides.
TYPED_TEST(Sides, ShareTheVolumeOfABodyBetweenRegions) {
  constexpr int dim = TypeParam::dim;
  auto simulation = simulation_on<TypeParam>(scene_of<dim>(
      "", box<dim>() + "ground.friction = 0.5\n[[body]]\nposition = " + vector_text<dim>(-4.9, 0.251) + "\n"));
  simulation.step();
  const auto volume = [&](double from, double to) {
    Vec<dim> low = Vec<dim>::Constant(-2.0);
    Vec<dim> high = Vec<dim>::Constant(2.0);
    low[0] = from;
    high[0] = to;
    return RegionMeter<dim>({.name = "region", .box = {low, high}}, 1.0).read(simulation.world(), 0.0).solid_volume;
  };
  const double whole = simulation.world().shape_of(0).volume;
  EXPECT_NEAR(volume(-5.0, -4.0), 0.6 * whole, 0.02 * whole);
  EXPECT_NEAR(volume(4.0, 5.0), 0.4 * whole, 0.02 * whole);
}

// A ball goes around 4.4 times. It passes the gate in the middle two times in the first half of that, then the gate at
// the sides three times.
TYPED_TEST(Sides, LetAGateCountOnceARound) {
  constexpr int dim = TypeParam::dim;
  auto simulation = simulation_on<TypeParam>(scene_of<dim>(
      ", gravity = 0", "ground.present = false\n" + ball<dim> + "[[body]]\nposition = " + vector_text<dim>(2.5, 0.0) +
                           "\nvelocity = " + vector_text<dim>(5.0, 0.0) + "\n"));
  for (const auto& [place, count] : {std::pair(0.0, 2), std::pair(5.0, 3)}) {
    GateParams<dim> gate{.name = "gate"};
    gate.normal = Vec<dim>::Unit(0);
    gate.centre = place * Vec<dim>::Unit(0);
    gate.radius = 2.0;
    GateCounter<dim> counter(gate, 1.0);
    const double until = simulation.time() + 4.4;
    while (simulation.time() < until) {
      simulation.step();
      counter.update(simulation.world(), simulation.time(), 1.0 / 60.0);
    }
    EXPECT_EQ(counter.forward(), count);
    EXPECT_EQ(counter.backward(), 0);
  }
}

// The bits of bodies in units of the engine are those of the same scene in metres, a power of four larger.
TYPED_TEST(Sides, AreAsGoodForSmallBodies) {
  constexpr int dim = TypeParam::dim;
  const auto end = [](double size) {
    WorldDescription<dim> world;
    world.periodic_x = size * Vec<2>(-5.0, 5.0);
    world.dt = std::sqrt(size) / 60.0;
    world.solver.restitution_threshold *= std::sqrt(size);
    world.shapes.push_back(make_shape<dim>("box", box_pieces<dim>(Vec<dim>(Vec<dim>::Constant(size))), {}));
    world.units = fitting_units(world);
    auto made = TypeParam::make(world);
    for (int i = 0; i < 6; ++i) {
      BodyDef<dim> body;
      body.pose.position = size * (up<dim>(1.0 + 1.2 * i) + (4.8 + 0.1 * i) * Vec<dim>::Unit(0));
      made->add(body);
    }
    for (int step = 0; step < 300; ++step) made->step();
    std::vector<Vec<dim>> places;
    for (const Pose<dim>& pose : made->states().pose) places.push_back(pose.position / size);
    return places;
  };
  EXPECT_EQ(end(1.0), end(1.0 / 256.0));
}

// An obstacle at one side carries a box at the other one. It is taken away while the box sleeps.
TYPED_TEST(Sides, LetABoxBeFoundWhereItSticksOutThroughThem) {
  constexpr int dim = TypeParam::dim;
  for (const double side : {-1.0, 1.0}) {
    auto simulation = simulation_on<TypeParam>(
        scene_of<dim>("", box<dim>() + "[[body]]\nposition = " + vector_text<dim>(4.9 * side, 0.25) + "\n"));
    simulation.step();
    const auto at = [&](double x) {
      Vec<dim> place = up<dim>(0.25);
      place[0] = x;
      std::vector<BodyIndex> found;
      simulation.world().query_box({place - Vec<dim>::Constant(0.05), place + Vec<dim>::Constant(0.05)}, found);
      return !found.empty();
    };
    EXPECT_TRUE(at(-4.7 * side)) << "it goes on for 0.4 m behind the other side";
    EXPECT_FALSE(at(-4.0 * side));
  }
}

TYPED_TEST(Sides, PassOnThatASupportIsGone) {
  constexpr int dim = TypeParam::dim;
  const std::string text =
      "ground.friction = 0.5\n" + box<dim>() +
      fmt::format(
          "[[obstacle]]\nname = \"table\"\nkind = \"box\"\nsize = {}\nposition = {}\n[[body]]\nposition = {}\n"
          "[[event]]\ntime = 4\ndo = \"remove\"\nobstacle = \"table\"\n",
          dim == 2 ? "[1, 1]" : "[1, 1, 1]", vector_text<dim>(4.7, 0.501), vector_text<dim>(-4.99, 1.252));
  const Scene<dim> scene = scene_of<dim>("", text, "adaptive");
  EXPECT_GT(scene.policy.adaptive.rings, 0);
  auto simulation = simulation_on<TypeParam>(scene);
  run_until(simulation, 3.9);
  EXPECT_TRUE(simulation.world().awake().empty());
  EXPECT_NEAR(TestFixture::states(simulation).pose[0].position[dim - 1], 1.25, 0.01);
  run_until(simulation, 8.0);
  EXPECT_NEAR(TestFixture::states(simulation).pose[0].position[dim - 1], 0.25, 0.01);
}

// The ground carries the weight of a sleeping bridge over the sides, and that of a box that falls onto it.
TYPED_TEST(Sides, PassOnTheWeightOfWhatSleeps) {
  constexpr int dim = TypeParam::dim;
  std::string text = "ground.friction = 0.5\n" + box<dim>() + "policy.adaptive.rings = 2\n";
  for (const auto& [x, z] : {std::pair(4.3, 0.251), std::pair(-4.3, 0.251), std::pair(-4.99, 0.753)})
    text += fmt::format("[[body]]\nposition = {}\n", vector_text<dim>(x, z));
  text += fmt::format("[[source]]\nposition = {}\nstart = 4\ncount = 1\nspread = {}\nspin_spread = 0\n{}\n",
                      vector_text<dim>(5.0, 1.5), dim == 2 ? "[0, 0]" : "[0, 0, 0]",
                      dim == 2 ? "angle_deg = 0" : "angle_deg = 0\naxis = [0, 0, 1]");
  auto simulation = simulation_on<TypeParam>(scene_of<dim>("", text, "adaptive"));
  for (const auto& [time, bodies] : {std::pair(3.9, 3), std::pair(10.0, 4)}) {
    run_until(simulation, time);
    ASSERT_TRUE(simulation.world().awake().empty());
    std::vector<Contact<dim>> contacts;
    simulation.world().sleeping_contacts(ground_index, contacts);
    double impulse = 0.0;
    for (const Contact<dim>& contact : contacts) impulse += contact.normal_impulse;
    const double weight = bodies * simulation.world().shape_of(0).mass * gravity;
    EXPECT_NEAR(impulse / simulation.world().dt(), weight, 0.01 * weight);
    contacts.clear();
    simulation.world().sleeping_contacts(2, contacts);  // what lies on the two others, and carries the fourth
    for (const Contact<dim>& contact : contacts) EXPECT_EQ(contact.b, 2);
    EXPECT_FALSE(contacts.empty());
  }
}

TYPED_TEST(Sides, MustBeFourExtentsApart) {
  constexpr int dim = TypeParam::dim;
  WorldDescription<dim> world;
  world.shapes.push_back(make_shape<dim>("box", box_pieces<dim>(Vec<dim>(Vec<dim>::Ones())), {}));
  for (const auto& [extents, throws] : {std::pair(4.1, false), std::pair(3.9, true)}) {
    world.periodic_x = Vec<2>(0.0, extents * world.shapes[0].extent);
    if (throws)
      EXPECT_THROW(TypeParam::make(world), std::invalid_argument);
    else
      EXPECT_NO_THROW(TypeParam::make(world));
  }
}

#ifdef TALUS_BULLET
TEST(SidesOfTwoAxes, LetBodiesCollideThroughTheirCorner) {
  const std::string text =
      "ground.present = false\nshape.ball = {kind = \"ball\", radius = 0.5, friction = 0, restitution = 1}\n"
      "[[body]]\nposition = [4, -3, 0]\nvelocity = [3, -3, 0]\n[[body]]\nposition = [-4, 3, 0]\n";
  auto simulation = simulation_on<Bullet>(scene_of<3>(", gravity = 0", text));
  while (simulation.time() < 2.0) simulation.step();
  EXPECT_NEAR((simulation.world().states().velocity[1] - Vec<3>(3.0, -3.0, 0.0)).norm(), 0.0, 0.05);
  EXPECT_NEAR(simulation.world().states().velocity[0].norm(), 0.0, 0.05);
}
#endif

}  // namespace
}  // namespace talus::periodic_test

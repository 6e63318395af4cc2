// Bodies of any size in metres, on every engine.

#include <fmt/format.h>

#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "tests/backends/backend.h"

namespace talus::real_sizes_test {
namespace {

template <int Dim>
Scene<Dim> read(const std::string& rest) {
  return std::get<Scene<Dim>>(parse_scene(
      fmt::format("title = \"Sizes\"\ndimension = {}\nrun = {{frames = 9000, frame_rate = 1}}\n{}", Dim, rest),
      "text"));
}

/// [x, z] in 2D, [x, y, z] in 3D.
template <int Dim>
std::string vector(double x, double y, double z) {
  return Dim == 2 ? fmt::format("[{}, {}]", x, z) : fmt::format("[{}, {}, {}]", x, y, z);
}
template <int Dim>
std::string at_height(double z) {
  return vector<Dim>(0.0, 0.0, z);
}

/// Twenty boxes poured beside a moving obstacle, all lengths times `lengths` and all times times `times`.
template <int Dim>
Scene<Dim> pour(double lengths, double times, const std::string& policy) {
  const double l = lengths;
  const double speeds = lengths / times;
  return read<Dim>(fmt::format(
      "policy.kind = \"{}\"\nworld.steps_per_second = {}\nworld.solver.restitution_threshold = {}\n"
      "shape.box = {{kind = \"box\", size = {}, friction = 0.6, restitution = 0.2}}\n"
      "source = [{{count = 20, rate = {}, position = {}, velocity = {}, spread = {}}}]\npile = [{{alpha_deg = 30}}]\n"
      "[[obstacle]]\nkind = \"box\"\nsize = {}\nposition = {}\n"
      "motion = {{kind = \"sine\", amplitude = {}, frequency = {}, end = {}}}\n",
      policy, 60.0 / times, 0.5 * speeds, vector<Dim>(l, l, 0.75 * l), 4.0 / times, at_height<Dim>(8.0 * l),
      at_height<Dim>(-4.0 * speeds), vector<Dim>(0.25 * l, 0.25 * l, 0.0), vector<Dim>(0.5 * l, 4.0 * l, 2.0 * l),
      vector<Dim>(2.0 * l, 0.0, 1.0 * l), vector<Dim>(0.25 * l, 0.0, 0.0), 0.5 / times, 4.0 * times));
}

template <typename Backend>
class RealSizes : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;
  static void run(Simulation<dimension>& simulation, double time) {
    while (simulation.time() < time - 1e-9) simulation.step();
  }
};

TYPED_TEST_SUITE(RealSizes, Backends, BackendName);

// Factors are powers of two, so nothing is rounded.
TYPED_TEST(RealSizes, GiveTheSameBitsAsTheSameSceneInMetres) {
  constexpr int dim = TypeParam::dim;
  for (const char* policy : {"full", "adaptive", "paper"}) {
    SCOPED_TRACE(policy);
    const Scene<dim> of_grains = pour<dim>(1.0 / 1024.0, 1.0 / 32.0, policy);
    EXPECT_EQ(of_grains.world.units.power, 5);
    auto large = simulation_on<TypeParam>(pour<dim>(1.0, 1.0, policy));
    auto small = simulation_on<TypeParam>(of_grains);
    for (int step = 0; step < 600; ++step) {
      large.step();
      small.step();
      const BodyStates<dim>& expected = large.world().states();
      const BodyStates<dim>& states = small.world().states();
      ASSERT_EQ(states.size(), expected.size());
      for (BodyIndex body = 0; body < states.size(); ++body) {
        ASSERT_EQ(1024.0 * states.pose[body].position, expected.pose[body].position) << step << ", body " << body;
        ASSERT_EQ(32.0 * states.velocity[body], expected.velocity[body]) << step << ", body " << body;
        ASSERT_EQ(states.asleep[body], expected.asleep[body]) << step << ", body " << body;
      }
    }
    ASSERT_EQ(small.world().states().size(), 20);
    EXPECT_EQ(large.world().awake().size(), small.world().awake().size());
  }
}

// z = z0 - g t^2 / 2, by steps dt: g dt t / 2 more.
TYPED_TEST(RealSizes, FallAsFastAsBodiesDo) {
  constexpr int dim = TypeParam::dim;
  auto simulation = simulation_on<TypeParam>(read<dim>(fmt::format(
      "shape.grain = {{kind = \"ball\", radius = 0.0005}}\nbody = [{{position = {}}}]\n", at_height<dim>(0.05))));
  TestFixture::run(simulation, 0.05);
  const double dt = simulation.world().dt();
  EXPECT_LE(dt, 1.0 / 1800.0);
  EXPECT_NEAR(height<dim>(simulation.world().states().pose[0].position), 0.05 - 0.5 * 9.81 * 0.05 * 0.05,
              9.81 * dt * 0.05 + 1e-5);
}

// Box2D's own solver keeps a coin 6 % of its half thickness above the ground.
TYPED_TEST(RealSizes, RestAtHalfTheirHeight) {
  constexpr int dim = TypeParam::dim;
  struct Case {
    std::string shape;
    double half;  // of its height [m]
    double time;  // after which it rests [s]
  };
  const std::vector<Case> cases = {
      {dim == 2 ? "kind = \"box\", size = [0.024, 0.002]" : "kind = \"cylinder\", radius = 0.012, length = 0.002",
       0.001, 0.5},
      {"kind = \"box\", size = " + vector<dim>(0.04, 0.04, 0.04), 0.02, 1.0},
      {"kind = \"ball\", radius = 0.0005", 0.0005, 0.2},
      {"kind = \"box\", size = " + vector<dim>(50, 50, 50), 25.0, 20.0},
  };
  for (const Case& each : cases) {
    SCOPED_TRACE(each.shape);
    auto simulation = simulation_on<TypeParam>(read<dim>(
        fmt::format("shape.it = {{{}}}\nbody = [{{position = {}}}]\n", each.shape, at_height<dim>(2.0 * each.half))));
    TestFixture::run(simulation, each.time);
    EXPECT_NEAR(height<dim>(simulation.world().states().pose[0].position), each.half, 0.07 * each.half);
    EXPECT_TRUE(simulation.world().awake().empty());
  }
}

TYPED_TEST(RealSizes, WeighOnTheGroundWhatTheyWeigh) {
  constexpr int dim = TypeParam::dim;
  const Scene<dim> scene = read<dim>(
      fmt::format("policy.kind = \"full\"\nshape.cube = {{kind = \"box\", size = {}}}\nbody = [{{position = {}}}]\n",
                  vector<dim>(0.01, 0.01, 0.01), at_height<dim>(0.005)));
  auto world = TypeParam::make(scene.world);
  world->add(scene.bodies[0].def);
  world->record_contacts(true);
  double impulse = 0.0;
  constexpr int settled = 200;
  constexpr int steps = 400;
  for (int step = 0; step < steps; ++step) {
    world->step();
    if (step < settled) continue;
    for (const Contact<dim>& contact : world->contacts()) impulse += contact.normal_impulse;
  }
  const double force = impulse / ((steps - settled) * world->dt());
  const double weight = scene.world.shapes[0].mass * 9.81;
  EXPECT_NEAR(force, weight, 0.01 * weight);
}

TYPED_TEST(RealSizes, NeedMoreStepsTheSmallerTheyAre) {
  constexpr int dim = TypeParam::dim;
  const auto text = [](double steps) {
    return fmt::format(
        "world.steps_per_second = {}\nshape.grain = {{kind = \"ball\", radius = 0.0005}}\nsource = [{{position = "
        "{}}}]\n",
        steps, at_height<dim>(0.1));
  };
  EXPECT_THROW(read<dim>(text(60)), std::exception);
  EXPECT_NO_THROW(read<dim>(text(1920)));
}

}  // namespace
}  // namespace talus::real_sizes_test

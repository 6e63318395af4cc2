// Sleeping bodies that feel forces: policy.adaptive.rings, World::set_ring().

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "common/world/energy.h"
#include "tests/backends/backend.h"

namespace talus::ring_test {
namespace {

template <typename Backend>
class RingTest : public BackendTest<Backend> {
 protected:
  static constexpr int dim = Backend::dim;

  static std::unique_ptr<World<dim>> world_with_ring(const WorldDescription<dim>& description) {
    auto world = Backend::make(description);
    world->set_ring(SleepRing{});
    return world;
  }

  /// A vector as a scene has it: across and up, and the third in between.
  static std::string vector(double across, double up, double between = 0.0) {
    return dim == 2 ? fmt::format("[{}, {}]", across, up) : fmt::format("[{}, {}, {}]", across, between, up);
  }

  static Scene<dim> scene(const std::string& text) {
    return std::get<Scene<dim>>(
        parse_scene(fmt::format("title = \"ring\"\ndimension = {}\nworld.solver.kind = \"small_steps\"\n"
                                "policy.adaptive.rings = 2\n{}",
                                dim, text),
                    "text"));
  }

  using BackendTest<Backend>::run;
  static void run(Simulation<dim>& simulation, double seconds) {
    for (auto steps = std::llround(60.0 * seconds); steps > 0; --steps) simulation.step();
  }
};

TYPED_TEST_SUITE(RingTest, SmallStepsBackends, BackendName);

TYPED_TEST(RingTest, ABallThatRunsIntoARowOfSleepersPassesItsMomentumOnInThatStep) {
  auto description = TestFixture::description();
  description.gravity = 0.0;
  auto world = TestFixture::world_with_ring(description);
  const auto away = [](double x) {
    return Vec<TypeParam::dim>(x * Vec<TypeParam::dim>::Unit(0) + up<TypeParam::dim>(5.0));
  };
  world->add(TestFixture::at(away(0.0), 1, 2.0 * Vec<TypeParam::dim>::Unit(0)));
  const std::vector<BodyIndex> row = {1, 2, 3, 4, 5};
  // The ball touches the first early in a step, of which the rest is long enough for the impact to reach the last.
  for (const BodyIndex body : row) world->add(TestFixture::at(away(0.18 + body), 1));
  world->step();
  world->freeze(row);
  double before = 2.0;
  for (int step = 0; step < 30 && world->stirred().empty(); ++step) {
    before = world->states().velocity[0][0];
    world->step();
  }
  const std::vector<BodyIndex> stirred(world->stirred().begin(), world->stirred().end());
  EXPECT_EQ(stirred, row);
  world->thaw(stirred);
  double after = 0.0;
  for (BodyIndex body = 0; body < 6; ++body) after += world->states().velocity[body][0];
  EXPECT_NEAR(after, before, 5e-5) << "all weigh the same; single precision";
}

// Full heaps of these balls rest after 6 to 11 s. A sleeping body that forces have moved may overlap another before the
// engine finds their contact: such contacts start deep, and shake the heap for 20 s.
TYPED_TEST(RingTest, AHeapOfBallsComesToRest) {
  for (int seed = 1; seed <= 4; ++seed) {
    auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
        "seed = {}\nshape.ball = {{kind = \"ball\", radius = 0.5, friction = 0.5, rolling_friction = 0.02}}\n"
        "obstacle = [{{kind = \"container\", inner_size = {}}}]\npile = [{{}}]\n"
        "source = [{{count = 60, rate = 20, position = {}, velocity = {}, spread = {}}}]\n",
        seed, TypeParam::dim == 2 ? "[9, 14]" : "[4, 4, 8]",
        TestFixture::vector(0.0, TypeParam::dim == 2 ? 14.0 : 10.0), TestFixture::vector(0.0, -8.0),
        TypeParam::dim == 2 ? "[3, 0]" : "[1, 1, 0]")));
    TestFixture::run(simulation, 12.0);
    EXPECT_EQ(simulation.world().states().size(), 60);
    EXPECT_EQ(simulation.world().awake().size(), 0U) << "seed " << seed;
  }
}

// Four times as far as the ring goes.
TYPED_TEST(RingTest, ABoxThatHitsARowOfSleepersThrowsItAsFarAsARowThatIsAwake) {
  std::array<double, 2> moved{};
  for (const int full : {0, 1}) {
    auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
        "policy.kind = \"{}\"\nrun = {{frames = 300}}\nground = {{friction = 0.1}}\n"
        "shape.box = {{kind = \"box\", size = {}, friction = 0.1}}\n"
        "body = [{{position = {}, velocity = {}}}, {{position = {}, repeat = {}, step = {}, asleep = true}}]\n",
        full == 1 ? "full" : "adaptive", TestFixture::vector(1, 1, 1), TestFixture::vector(-2.5, 0.5),
        TestFixture::vector(6, 0), TestFixture::vector(0, 0.5), TypeParam::dim == 2 ? "[8, 1]" : "[8, 1, 1]",
        TestFixture::vector(1, 0))));
    TestFixture::run(simulation, 4.0);
    for (BodyIndex body = 1; body < 9; ++body)
      moved[full] += simulation.world().states().pose[body].position[0] - (body - 1);
  }
  EXPECT_GT(moved[1], 1.0);
  EXPECT_NEAR(moved[0], moved[1], 0.1 * moved[1]) << "boxes collide in another order once they differ by a bit";
}

TYPED_TEST(RingTest, AForceOnTheFirstOfARowOfSleepersMovesAllOfThem) {
  auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
      "run = {{frames = 300}}\nground = {{friction = 0.5}}\nshape.box = {{kind = \"box\", size = {}, friction = 0.5, "
      "density = 1000}}\nbody = [{{position = {}, repeat = {}, step = {}}}]\n"
      "event = [{{time = 2, do = \"force\", body = 0, force = {}}}]\n",
      TestFixture::vector(1, 1, 1), TestFixture::vector(0, 0.5), TypeParam::dim == 2 ? "[10, 1]" : "[10, 1, 1]",
      TestFixture::vector(1, 0), TestFixture::vector(12 * 0.5 * 9810, 0))));
  TestFixture::run(simulation, 2.0);
  EXPECT_TRUE(simulation.world().awake().empty());
  TestFixture::run(simulation, 3.0);
  // Ten boxes of 1 t, with two tenths of their friction too much: 0.981 m/s^2 for 3 s.
  EXPECT_NEAR(simulation.world().states().pose[9].position[0] - 9.0, 4.41, 0.15);
}

TYPED_TEST(RingTest, AWeightTipsASeesawOnWhichTheOtherEndSleeps) {
  auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
      "run = {{frames = 300}}\nground = {{height = -3}}\nshape.plank = {{kind = \"box\", size = {}, friction = 0.8}}\n"
      "shape.weight = {{kind = \"box\", size = {}, friction = 0.8}}\n"
      "body = [{{shape = \"plank\", position = {}}}, {{shape = \"weight\", position = {}}}, {{shape = \"weight\", "
      "position = {}}}]\nsource = [{{count = 1, start = 4, position = {}, spread = {}, angle_deg = 0{}, shape = "
      "\"weight\"}}]\nobstacle = [{{kind = \"box\", size = {}, position = {}, friction = 0.8}}]\n",
      TestFixture::vector(8, 0.4, 0.5), TestFixture::vector(0.8, 0.8, 0.8), TestFixture::vector(0, 1.2),
      TestFixture::vector(-3, 1.8), TestFixture::vector(3, 1.8), TestFixture::vector(3, 3), TestFixture::vector(0, 0),
      TypeParam::dim == 2 ? "" : ", axis = [0, 0, 1]", TestFixture::vector(0.6, 1, 2), TestFixture::vector(0, 0.5))));
  TestFixture::run(simulation, 3.9);
  EXPECT_TRUE(simulation.world().awake().empty());
  TestFixture::run(simulation, 4.0);
  EXPECT_LT(talus::height<TypeParam::dim>(simulation.world().states().pose[2].position), 0.5) << "it lay at 1.8 m";
}

// On slopes; the ground is level, and gravity is not.
TYPED_TEST(RingTest, ABallThatTurnsBackOnASlopeRollsDown) {
  for (const double slope : {in_radians(1.5), in_radians(3.5)}) {
    auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
        "run = {{frames = 400}}\nworld.gravity = {}\nshape.ball = {{kind = \"ball\", radius = 0.5, friction = 0.5}}\n"
        "body = [{{position = {}, velocity = {}, spin = {}}}]\n",
        TestFixture::vector(-9.81 * std::sin(slope), -9.81 * std::cos(slope)), TestFixture::vector(0, 0.5),
        TestFixture::vector(1, 0), TypeParam::dim == 2 ? "-2" : "[0, 2, 0]")));
    TestFixture::run(simulation, 10.0);
    // It rolls: an inertia of 1/2 (2D) and 2/5 m r^2.
    const double acceleration = 9.81 * std::sin(slope) / (TypeParam::dim == 2 ? 1.5 : 1.4);
    const double to = 10.0 - 0.5 * acceleration * 100.0;
    EXPECT_NEAR(simulation.world().states().pose[0].position[0], to, 0.2) << "it lands a little at the start";
  }
}

TYPED_TEST(RingTest, ABoxOnASlopeSlidesFromTheAngleOfFrictionOn) {
  for (const double degrees : {26.0, 27.0, 27.5}) {
    const double slope = in_radians(degrees);
    auto simulation = simulation_on<TypeParam>(TestFixture::scene(
        fmt::format("run = {{frames = 400}}\nworld.gravity = {}\nground = {{friction = 0.5}}\n"
                    "shape.box = {{kind = \"box\", size = {}, friction = 0.5}}\nbody = [{{position = {}}}]\n",
                    TestFixture::vector(-9.81 * std::sin(slope), -9.81 * std::cos(slope)), TestFixture::vector(1, 1, 1),
                    TestFixture::vector(0, 0.5))));
    std::array<double, 3> at{};
    for (double& place : at) {
      TestFixture::run(simulation, 1.5);
      place = simulation.world().states().pose[0].position[0];
    }
    const double acceleration = std::max(0.0, 9.81 * (std::sin(slope) - 0.5 * std::cos(slope)));
    EXPECT_NEAR(at[0] - 2.0 * at[1] + at[2], -acceleration * 1.5 * 1.5, 0.01) << degrees;
  }
}

TYPED_TEST(RingTest, ABoxOnAPlateThatTurnsSlowlySlidesAtTheAngleOfFriction) {
  for (const double place : {0.0, 1.0}) {
    auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
        "run = {{frames = 2000}}\nground = {{height = -30}}\nshape.box = {{kind = \"box\", size = {}, friction = "
        "0.5}}\n"
        "body = [{{position = {}}}]\nobstacle = [{{kind = \"box\", size = {}, position = {}, friction = 0.5, "
        "motion = {{kind = \"turn\", speed_deg = 0.5, start = 2{}}}}}]\n",
        TestFixture::vector(1, 1, 1), TestFixture::vector(place, 1), TestFixture::vector(30, 1, 10),
        TestFixture::vector(0, 0), TypeParam::dim == 2 ? "" : ", axis = [0, -1, 0]")));
    const auto along_plate = [&](double angle) {
      const Vec<TypeParam::dim>& at = simulation.world().states().pose[0].position;
      return at[0] * std::cos(angle) + talus::height<TypeParam::dim>(at) * std::sin(angle);
    };
    TestFixture::run(simulation, 2.0);
    const double from = along_plate(0.0);
    TestFixture::run(simulation, 52.0);
    EXPECT_NEAR(along_plate(in_radians(26.0)), from, 0.05) << "at 26 degrees, 0.6 below the angle";
    TestFixture::run(simulation, 5.0);
    EXPECT_LT(along_plate(in_radians(28.5)), from - 0.5) << "at 28.5 degrees";
  }
}

TYPED_TEST(RingTest, ASleepingPlankStaysOnTheBallThatLiftsIt) {
  auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
      "run = {{frames = 3000}}\nground = {{friction = 1}}\n"
      "shape.plank = {{kind = \"box\", size = {}, friction = 0.5, density = 2000}}\nbody = [{{position = {}}}]\n"
      "obstacle = [{{kind = \"box\", size = {}, position = {}, friction = 1}}, {{kind = \"ball\", radius = 0.5, "
      "position = {}, friction = 0, motion = {{kind = \"path\", times = [4, 74], shifts = [{}, {}]}}}}]\n",
      TestFixture::vector(10, 0.4, 2), TestFixture::vector(0, 0.2), TestFixture::vector(1, 3, 3),
      TestFixture::vector(-5.51, -1.2), TestFixture::vector(4, -0.51), TestFixture::vector(0, 0),
      TestFixture::vector(0, 5.5))));
  TestFixture::run(simulation, 80.0);
  EXPECT_TRUE(simulation.world().awake().empty());
  const Pose<TypeParam::dim>& plank = simulation.world().states().pose[0];
  Vec<TypeParam::dim> ball = up<TypeParam::dim>(4.99);
  ball[0] = 4.0;
  const Vec<TypeParam::dim> in_plank = plank.rotation.inverse() * Vec<TypeParam::dim>(ball - plank.position);
  EXPECT_NEAR(talus::height<TypeParam::dim>(in_plank), -0.7, 0.04) << "half of its thickness and the ball's radius";
}

TYPED_TEST(RingTest, ABodyWakesWhenItsSupportVanishes) {
  auto world = TestFixture::world_with_ring(TestFixture::description());
  for (const double height : {0.5, 1.5, 2.5}) world->add(TestFixture::at(up<TypeParam::dim>(height)));
  TestFixture::run(*world, 2.0);
  world->freeze(std::vector<BodyIndex>{0, 1, 2});
  TestFixture::run(*world, 1.0);
  EXPECT_TRUE(world->stirred().empty());
  EXPECT_EQ(world->solved_sleepers(), 0) << "nothing moves";
  world->remove(0);
  int steps = 0;
  for (; steps < 10 && world->stirred().empty(); ++steps) world->step();
  // Falling freely: 0.14 sqrt(g D) = 0.44 m/s takes 2.7 steps.
  EXPECT_LE(steps, 4);
  EXPECT_EQ(std::vector<BodyIndex>(world->stirred().begin(), world->stirred().end()), (std::vector<BodyIndex>{1, 2}));
}

// 9.81 m/s^2 (sin 20 - 0.3 cos 20) = 0.59 m/s^2: in its first step without the stop a box is slower than what is still.
TYPED_TEST(RingTest, ARowOnASlopeSlidesOnceItsStopIsRemoved) {
  auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
      "world.gravity = {}\nrun = {{frames = 300}}\nground = {{friction = 0.3}}\n"
      "shape.box = {{kind = \"box\", size = {}, friction = 0.3}}\nbody = [{{position = {}, repeat = {}, step = {}}}]\n"
      "obstacle = [{{name = \"stop\", kind = \"box\", size = {}, position = {}}}]\n"
      "event = [{{time = 2, do = \"remove\", obstacle = \"stop\"}}]\n",
      TestFixture::vector(9.81 * std::sin(0.349066), -9.81 * std::cos(0.349066)), TestFixture::vector(1, 0.6, 1),
      TestFixture::vector(-2.5, 0.3), TypeParam::dim == 2 ? "[3, 1]" : "[3, 1, 1]", TestFixture::vector(1, 0),
      TestFixture::vector(1, 1, 1), TestFixture::vector(0.5, 0.5))));
  TestFixture::run(simulation, 2.0);
  EXPECT_TRUE(simulation.world().awake().empty());
  TestFixture::run(simulation, 4.0);
  // By 4.7 m. The boxes behind begin to slide when the one before them has moved on.
  for (BodyIndex body = 0; body < 3; ++body)
    EXPECT_NEAR(simulation.world().states().pose[body].position[0] - (body - 2.5), 4.72, 0.25) << body;
}

TYPED_TEST(RingTest, APlankTipsOverAnEdgeOnceItsCounterweightIsRemoved) {
  auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
      "run = {{frames = 300}}\nshape.plank = {{kind = \"box\", size = {}}}\n"
      "shape.weight = {{kind = \"box\", size = {}, density = 2000}}\n"
      "body = [{{shape = \"plank\", position = {}}}, {{shape = \"weight\", position = {}}}]\n"
      "obstacle = [{{kind = \"box\", size = {}, position = {}}}]\nevent = [{{time = 4, do = \"remove\", body = 1}}]\n",
      TestFixture::vector(4, 0.3, 1), TestFixture::vector(0.7, 0.7, 0.7), TestFixture::vector(0.1, 6.15),
      TestFixture::vector(-1.5, 6.65), TestFixture::vector(8, 6, 4), TestFixture::vector(-4, 3))));
  TestFixture::run(simulation, 4.0);
  EXPECT_TRUE(simulation.world().awake().empty());
  TestFixture::run(simulation, 6.0);
  EXPECT_LT(height<TypeParam::dim>(simulation.world().states().pose[0].position), 5.0);
}

// The shelf stops where the plank's centre is 0.1 m beyond its edge; contact points must not go with the plank.
TYPED_TEST(RingTest, APlankFallsOffAShelfAsSoonAsOneThatIsAwake) {
  std::array<double, 2> fell{};
  for (const int full : {0, 1}) {
    auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
        "policy.kind = \"{}\"\nrun = {{frames = 420}}\nshape.plank = {{kind = \"box\", size = {}, friction = 0}}\n"
        "body = [{{position = {}}}]\n"
        "obstacle = [{{kind = \"box\", size = {}, position = {}, friction = 0, "
        "motion = {{kind = \"path\", times = [4, 5], shifts = [{}, {}]}}}}]\n",
        full == 1 ? "full" : "adaptive", TestFixture::vector(4, 0.3, 1), TestFixture::vector(0, 6.15),
        TestFixture::vector(4, 0.5, 4), TestFixture::vector(-1.1, 5.75), TestFixture::vector(0, 0),
        TestFixture::vector(-1, 0))));
    do {
      simulation.step();
    } while (simulation.time() < 10.0 && height<TypeParam::dim>(simulation.world().states().pose[0].position) > 5.0);
    fell[full] = simulation.time();
  }
  EXPECT_NEAR(fell[0], fell[1], 0.15);
}

// A hit that would make the last of a ring of two rebound.
TYPED_TEST(RingTest, ASlowHitOnARowOfSleepersLosesNoMomentum) {
  auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
      "run = {{frames = 300}}\nground = {{friction = 0}}\n"
      "shape.box = {{kind = \"box\", size = {}, friction = 0}}\n"
      "body = [{{position = {}, velocity = {}}}, {{position = {}, repeat = {}, step = {}, asleep = true}}]\n",
      TestFixture::vector(1, 1, 1), TestFixture::vector(-1.1, 0.5), TestFixture::vector(0.6, 0),
      TestFixture::vector(0, 0.5), TypeParam::dim == 2 ? "[6, 1]" : "[6, 1, 1]", TestFixture::vector(1, 0))));
  TestFixture::run(simulation, 3.0);
  double momentum = 0.0;
  for (const auto& velocity : simulation.world().states().velocity) momentum += velocity[0];
  EXPECT_NEAR(momentum, 0.6, 0.01) << "of bodies of equal mass";
}

TYPED_TEST(RingTest, BodiesThatWakeCarryTheLoadThatCameInTheirSleepFromTheFirstStep) {
  auto world = TestFixture::world_with_ring(TestFixture::description());
  for (const double height : {0.5, 1.5}) world->add(TestFixture::at(up<TypeParam::dim>(height)));
  TestFixture::run(*world, 2.0);
  world->freeze(std::vector<BodyIndex>{0, 1});
  for (const double height : {2.5, 3.5}) world->add(TestFixture::at(up<TypeParam::dim>(height)));
  TestFixture::run(*world, 3.0);
  EXPECT_TRUE(world->stirred().empty());
  world->thaw(std::vector<BodyIndex>{0, 1});
  world->step();
  double fastest = 0.0;
  for (BodyIndex body = 0; body < 4; ++body) fastest = std::max(fastest, world->states().velocity[body].norm());
  // Without the load of the upper two the lower ones would start with twice their weight in excess.
  EXPECT_LT(fastest, 1e-3);
}

TYPED_TEST(RingTest, AWallThatSleepsFromTheStartFallsWhenItsLowestRowIsRemoved) {
  auto simulation = simulation_on<TypeParam>(TestFixture::scene(
      fmt::format("run = {{frames = 600}}\nshape.cube = {{kind = \"box\", size = {}, friction = 0.5}}\n"
                  "body = [{{position = {}, repeat = {}, step = {}, asleep = true}}]\n",
                  TestFixture::vector(1, 1, 1), TestFixture::vector(0, 0.5),
                  TypeParam::dim == 2 ? "[4, 4]" : "[4, 1, 4]", TestFixture::vector(1, 1, 1))));
  TestFixture::run(simulation, 1.0);
  std::vector<double> from;
  for (const auto& pose : simulation.world().states().pose) from.push_back(height<TypeParam::dim>(pose.position));
  for (BodyIndex body = 0; body < 16; ++body)
    if (from[body] < 0.75) simulation.remove(body);
  TestFixture::run(simulation, 2.0);
  for (BodyIndex body = 0; body < 16; ++body)
    if (from[body] > 0.75) EXPECT_LT(TestFixture::height_of(simulation.world(), body), from[body] - 0.5) << body;
}

TYPED_TEST(RingTest, APileAtRestHasNoBodyInTheRing) {
  auto simulation = simulation_on<TypeParam>(TestFixture::scene(
      "run = {frames = 2400}\nshape.L = {kind = \"L\"}\nsource = [{count = 40, rate = 6.6}]\npile = [{}]\n"));
  TestFixture::run(simulation, 35.0);
  EXPECT_EQ(simulation.world().states().size(), 40);
  EXPECT_TRUE(simulation.world().awake().empty());
  EXPECT_EQ(simulation.world().solved_sleepers(), 0);
}

TYPED_TEST(RingTest, ASlowPlatformCarriesAStackOfSleepers) {
  // 10 mm/s for 20 s.
  auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
      "run = {{frames = 3000}}\nground.height = -10\nshape.cube = {{kind = \"box\", size = {}, friction = 0.6}}\n"
      "body = [{{position = {}, repeat = {}, step = {}}}]\n"
      "[[obstacle]]\nkind = \"box\"\nsize = {}\nposition = {}\nfriction = 0.6\n"
      "motion = {{kind = \"path\", times = [5, 25], shifts = [{}, {}]}}\n",
      TestFixture::vector(1, 1, 1), TestFixture::vector(0, 0.75), TypeParam::dim == 2 ? "[1, 3]" : "[1, 1, 3]",
      TestFixture::vector(1, 1), TestFixture::vector(4, 0.5, 4), TestFixture::vector(0, 0), TestFixture::vector(0, 0),
      TestFixture::vector(0.2, 0))));
  TestFixture::run(simulation, 5.0);
  std::vector<double> from;
  for (const auto& pose : simulation.world().states().pose) from.push_back(pose.position[0]);
  TestFixture::run(simulation, 22.0);
  for (BodyIndex body = 0; body < 3; ++body)
    EXPECT_NEAR(simulation.world().states().pose[body].position[0] - from[body], 0.2, 0.002) << "cube " << body;
}

TYPED_TEST(RingTest, ALiftThatLowersSleepersIsNotTakenForASourceOfEnergy) {
  auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
      "run = {{frames = 1000}}\nground.height = -10\nshape.cube = {{kind = \"box\", size = {}, friction = 0.6}}\n"
      "body = [{{position = {}, repeat = {}, step = {}}}]\nobstacle = [{{kind = \"box\", size = {}, position = {}, "
      "motion = {{kind = \"path\", times = [5, 25], shifts = [{}, {}]}}}}]\n",
      TestFixture::vector(1, 1, 1), TestFixture::vector(0, 0.75), TypeParam::dim == 2 ? "[1, 3]" : "[1, 1, 3]",
      TestFixture::vector(1, 1), TestFixture::vector(4, 0.5, 4), TestFixture::vector(0, 0), TestFixture::vector(0, 0),
      TestFixture::vector(0, -0.4))));
  Watcher<TypeParam::dim> watcher;  // without one nothing is checked
  simulation.add_observer(watcher);
  TestFixture::run(simulation, 27.0);
  EXPECT_TRUE(simulation.warnings().empty());
}

TYPED_TEST(RingTest, ARowThatASlowPusherMovesNeverHasTwiceTheEnergyOfItsSpeed) {
  // Four cubes, a hundredth of their size apart, at 10 mm/s for each metre of it. In its sleep one comes to the next.
  constexpr double speed = 0.01;
  for (const double size : {1.0, 4.0}) {
    auto simulation = simulation_on<TypeParam>(TestFixture::scene(fmt::format(
        "run = {{frames = 6000}}\nworld.gravity = {}\nshape.cube = {{kind = \"box\", size = {}, friction = 0.5}}\n"
        "body = [{{position = {}, repeat = {}, step = {}}}]\n"
        "[[obstacle]]\nkind = \"box\"\nsize = {}\nposition = {}\n"
        "motion = {{kind = \"path\", times = [2, 202], shifts = [{}, {}]}}\n",
        9.81 * size, TestFixture::vector(size, size, size), TestFixture::vector(1.6 * size, 0.51 * size),
        TypeParam::dim == 2 ? "[4, 1]" : "[4, 1, 1]", TestFixture::vector(1.01 * size, 0.0),
        TestFixture::vector(size, 2.0 * size, 2.0 * size), TestFixture::vector(0.5 * size, 1.2 * size),
        TestFixture::vector(0, 0), TestFixture::vector(200.0 * speed * size, 0))));
    TestFixture::run(simulation, 2.0);
    const double at_speed = 4.0 * 0.5 * simulation.world().shape_of(0).mass * std::pow(speed * size, 2);
    double most = 0.0;
    for (int step = 0; step < 12000; ++step) {
      simulation.step();
      most = std::max(most, kinetic_energy(simulation.world()));
    }
    EXPECT_GT(simulation.world().states().pose[0].position[0], 3.4 * size) << "the pusher has come that far";
    EXPECT_LT(most, 2.0 * at_speed) << "cubes of " << size << " m";
  }
}

TYPED_TEST(RingTest, DominoesThatGrowByTwoFifthsAllFall) {
  std::string shapes;
  std::string bodies;
  double height = 1.0;
  double place = 0.0;
  for (int i = 0; i < 5; ++i) {
    shapes += fmt::format("shape.d{} = {{kind = \"box\", size = {}, friction = 0.5}}\n", i,
                          TestFixture::vector(0.1 * height, height, 0.5 * height));
    bodies += fmt::format("[[body]]\nshape = \"d{}\"\nposition = {}\n", i, TestFixture::vector(place, 0.5 * height));
    // About its lower edge.
    if (i == 0)
      bodies += fmt::format("velocity = {}\nspin = {}\n", TestFixture::vector(1.5, 0),
                            TypeParam::dim == 2 ? "-3" : "[0, 3, 0]");
    place += 0.47 * height;
    height *= 1.4;
  }
  auto simulation = simulation_on<TypeParam>(TestFixture::scene("run = {frames = 600}\n" + shapes + bodies));
  TestFixture::run(simulation, 8.0);
  height = 1.0;
  for (BodyIndex body = 0; body < 5; ++body) {
    EXPECT_LT(talus::height<TypeParam::dim>(simulation.world().states().pose[body].position), 0.45 * height)
        << "domino " << body;
    height *= 1.4;
  }
}

TYPED_TEST(RingTest, ARunIsTheSameBitsAgain) {
  const auto scene = TestFixture::scene(
      "run = {frames = 600}\nshape.L = {kind = \"L\"}\nsource = [{count = 30, rate = 6.6}]\npile = [{}]\n");
  std::array<std::vector<Vec<TypeParam::dim>>, 2> ends;
  for (auto& end : ends) {
    auto simulation = simulation_on<TypeParam>(scene);
    TestFixture::run(simulation, 6.0);
    for (const auto& pose : simulation.world().states().pose) end.push_back(pose.position);
  }
  EXPECT_EQ(ends[0], ends[1]);
}

TYPED_TEST(RingTest, IsSetWhileNoBodySleepsOnly) {
  auto world = TypeParam::make(TestFixture::description());
  const BodyIndex body = world->add(TestFixture::at(up<TypeParam::dim>(0.5)));
  world->freeze(std::vector{body});
  EXPECT_THROW(world->set_ring(SleepRing{}), std::invalid_argument);
  world->thaw(std::vector{body});
  EXPECT_NO_THROW(world->set_ring(SleepRing{}));
}

template <typename Backend>
class RingOfOwnSolver : public BackendTest<Backend> {};
TYPED_TEST_SUITE(RingOfOwnSolver, Backends, BackendName);

TYPED_TEST(RingOfOwnSolver, IsRefusedAndThatOfSmallStepsTaken) {
  auto world = TypeParam::make(TestFixture::description());
  if (has_small_steps<TypeParam>) {
    EXPECT_NO_THROW(world->set_ring(SleepRing{}));
    return;
  }
  try {
    world->set_ring(SleepRing{});
    ADD_FAILURE() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("small_steps"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace talus::ring_test

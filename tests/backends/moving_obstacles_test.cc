// Obstacles that move by plan, on every engine.

#include <fmt/format.h>

#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "common/simulation/state_hash.h"
#include "tests/backends/backend.h"

namespace talus::moving_obstacles_test {
namespace {

/// A cube of 1 m on a platform whose upper side is at a height of 2 m, with this motion.
template <int Dim>
Scene<Dim> platform(const std::string& motion, const std::string& rest = "") {
  const std::string text = fmt::format(
      "title = \"Platform\"\ndimension = {}\nshape.cube = {{kind = \"box\", size = {}, friction = 0.8}}\n{}\n"
      "[[body]]\nposition = {}\n"
      "[[obstacle]]\nkind = \"box\"\nsize = {}\nposition = {}\nfriction = 0.8\nmotion = {}\n",
      Dim, Dim == 2 ? "[1, 1]" : "[1, 1, 1]", rest, Dim == 2 ? "[0, 2.5]" : "[0, 0, 2.5]",
      Dim == 2 ? "[6, 0.5]" : "[6, 6, 0.5]", Dim == 2 ? "[0, 1.75]" : "[0, 0, 1.75]", motion);
  return std::get<Scene<Dim>>(parse_scene(text, "text"));
}

/// From 2 s on by `x` and `height` within 2 s.
template <int Dim>
std::string path(double x, double height) {
  return fmt::format("{{kind = \"path\", times = [2, 4], shifts = [{}, {}]}}", vector_text<Dim>(0, 0),
                     vector_text<Dim>(x, height));
}

template <typename Backend>
class MovingObstacle : public ::testing::Test {
 protected:
  static constexpr int dimension = Backend::dim;
  static Vec<dimension> place(const Simulation<dimension>& simulation) {
    return simulation.world().states().pose[0].position;
  }
  static bool asleep(const Simulation<dimension>& simulation) { return simulation.world().awake().empty(); }
};

TYPED_TEST_SUITE(MovingObstacle, Backends, BackendName);

TYPED_TEST(MovingObstacle, CarriesASleeperAwayAndLetsItSleepWhenItStandsStill) {
  constexpr int dim = TypeParam::dim;
  const Scene<dim> scene = platform<dim>(path<dim>(2.0, 0.0));
  auto simulation = simulation_on<TypeParam>(scene);
  run_until(simulation, 2.0);
  EXPECT_TRUE(TestFixture::asleep(simulation)) << "before it moves";
  simulation.step();  // after it the contact may be found in which it moves the body
  for (int i = 0; i < 100; ++i) {
    simulation.step();
    ASSERT_FALSE(TestFixture::asleep(simulation)) << simulation.time();
  }
  run_until(simulation, 6.0);
  EXPECT_TRUE(TestFixture::asleep(simulation)) << "after it has moved";
  EXPECT_NEAR(TestFixture::place(simulation)[0], 2.0, 0.1);
  EXPECT_NEAR(height<dim>(TestFixture::place(simulation)), 2.5, 0.03);
  EXPECT_NEAR(simulation.world().obstacle_pose(0).position[0], 2.0, 1e-9);
}

TYPED_TEST(MovingObstacle, LiftsABodyWithoutThrowingIt) {
  constexpr int dim = TypeParam::dim;
  for (const char* policy : {"full", "adaptive", "engine"}) {
    if (!has_policy<TypeParam>(policy)) continue;
    SCOPED_TRACE(policy);
    auto simulation =
        simulation_on<TypeParam>(platform<dim>(path<dim>(0.0, 3.0), fmt::format("policy.kind = \"{}\"", policy)));
    run_until(simulation, 3.0);
    EXPECT_NEAR(height<dim>(TestFixture::place(simulation)), 4.0, 0.1);
    run_until(simulation, 6.0);
    EXPECT_NEAR(height<dim>(TestFixture::place(simulation)), 5.5, 0.03);
  }
}

TYPED_TEST(MovingObstacle, TurnsABodyWithIt) {
  constexpr int dim = TypeParam::dim;
  if constexpr (dim == 3) {
    auto simulation = simulation_on<TypeParam>(
        platform<dim>("{kind = \"turn\", speed_deg = 45, axis = [0, 0, 1], start = 1, end = 3}"));
    run_until(simulation, 5.0);
    const Vec3 side = simulation.world().states().pose[0].rotation * Vec3::UnitX();
    EXPECT_LT((side - Vec3::UnitY()).norm(), 0.1);
  } else {
    // Tilted by 60 degrees, it lets the body slide off.
    auto simulation = simulation_on<TypeParam>(platform<dim>("{kind = \"turn\", speed_deg = 30, start = 1, end = 3}"));
    run_until(simulation, 6.0);
    EXPECT_LT(height<dim>(TestFixture::place(simulation)), 1.0);
  }
}

/// A plan and how far it should have carried a body.
struct Carry {
  double steps_per_second = 60.0;
  double away = 0.0;   // of everything from the origin [m]
  double speed = 0.0;  // [m/s] or [degrees/s]
};

/// Distance that a cube on a platform goes within 2 s, as a share of the platform's.
template <typename Backend>
double carried_along(const Carry& carry) {
  constexpr int dim = Backend::dim;
  const std::string text = fmt::format(
      "title = \"Platform\"\ndimension = {}\nworld.steps_per_second = {}\npolicy.kind = \"full\"\n"
      "ground.present = false\nshape.cube = {{kind = \"box\", size = {}, friction = 0.8}}\n"
      "[[body]]\nposition = {}\n"
      "[[obstacle]]\nkind = \"box\"\nsize = {}\nposition = {}\nfriction = 0.8\n"
      "motion = {{kind = \"path\", times = [1, 101], shifts = [{}, {}]}}\n",
      dim, carry.steps_per_second, dim == 2 ? "[1, 1]" : "[1, 1, 1]", vector_text<dim>(carry.away, 0.5),
      dim == 2 ? "[6, 0.5]" : "[6, 6, 0.5]", vector_text<dim>(carry.away, -0.25), vector_text<dim>(0.0, 0.0),
      vector_text<dim>(100.0 * carry.speed, 0.0));
  const auto scene = std::get<Scene<dim>>(parse_scene(text, "text"));
  auto simulation = simulation_on<Backend>(scene);
  const auto place = [&] { return simulation.world().states().pose[0].position[0]; };
  while (simulation.time() < 1.5 - 1e-9) simulation.step();
  const double before = place();
  while (simulation.time() < 3.5 - 1e-9) simulation.step();
  return (place() - before) / (2.0 * carry.speed);
}

/// Angle by which a drum about a level axis, or in 3D a turntable, carries a box within 6 s, as a share of its own.
template <typename Backend>
double carried_around(const Carry& carry, bool upright) {
  constexpr int dim = Backend::dim;
  const std::string drum =
      fmt::format("kind = \"ring\"\nouter_radius = 6\ninner_radius = 5\nparts = 64\nfriction = 0.8\n{}position = {}\n",
                  dim == 2 ? "" : "depth = 2\n", vector_text<dim>(carry.away, 0.0));
  const std::string table = fmt::format("kind = \"box\"\nsize = [8, 8, 0.5]\nfriction = 0.8\nposition = {}\n",
                                        vector_text<dim>(carry.away, -5.22));
  const std::string text = fmt::format(
      "title = \"Drum\"\ndimension = {}\nworld.steps_per_second = {}\npolicy.kind = \"full\"\n"
      "ground.present = false\nshape.box = {{kind = \"box\", size = {}, friction = 0.8}}\n"
      "[[body]]\nposition = {}\n"
      "[[obstacle]]\n{}motion = {{kind = \"turn\", speed_deg = {}{}, start = 2}}\n",
      dim, carry.steps_per_second, dim == 2 ? "[1, 0.5]" : "[1, 0.5, 0.5]",
      vector_text<dim>(carry.away + (upright ? 3.0 : 0.0), -4.71), upright ? table : drum, carry.speed,
      dim == 2  ? ""
      : upright ? ", axis = [0, 0, 1]"
                : ", axis = [0, -1, 0]");
  const auto scene = std::get<Scene<dim>>(parse_scene(text, "text"));
  auto simulation = simulation_on<Backend>(scene);
  const auto angle = [&] {
    const Vec<dim> arm = simulation.world().states().pose[0].position - carry.away * Vec<dim>::Unit(0);
    return upright ? std::atan2(arm[1], arm[0]) : std::atan2(arm[0], -height<dim>(arm));
  };
  while (simulation.time() < 2.5 - 1e-9) simulation.step();
  const double before = angle();
  while (simulation.time() < 8.5 - 1e-9) simulation.step();
  return (angle() - before) / in_radians(6.0 * carry.speed);
}

// Within 1 % over 2 s, from half a second after the start on, when friction has brought the cube to speed: it needs
// v / (mu g), 0.03 s at 0.2 m/s. Single precision adds up to 0.2 % at 960 steps a second.
TYPED_TEST(MovingObstacle, CarriesACubeAsFastAsItGoes) {
  for (const double steps : {60.0, 960.0})
    for (const double speed : {0.001, 0.005, 0.02, 0.2})
      EXPECT_NEAR(carried_along<TypeParam>({steps, 0.0, speed}), 1.0, 0.01) << speed << " m/s, " << steps;
}

// Within 1 % over 6 s: now and then a box settles by 2 mm between two parts of the drum.
TYPED_TEST(MovingObstacle, CarriesABoxAroundAsFastAsItTurns) {
  constexpr int dim = TypeParam::dim;
  for (const double steps : {60.0, 960.0}) {
    for (const double speed : {1.0, 5.0}) {
      EXPECT_NEAR(carried_around<TypeParam>({steps, 0.0, speed}, false), 1.0, 0.01)
          << "drum, " << speed << " degrees/s, " << steps;
      if (dim == 3) {
        EXPECT_NEAR(carried_around<TypeParam>({steps, 0.0, speed}, true), 1.0, 0.01)
            << "table, " << speed << " degrees/s, " << steps;
      }
    }
  }
}

TYPED_TEST(MovingObstacle, CarriesFarFromTheOriginToo) {
  // Single precision resolves 6e-5 m there: a step of 0.003 m is off by 1 % at most.
  EXPECT_NEAR(carried_along<TypeParam>({60.0, 1000.0, 0.2}), 1.0, 0.01);
  EXPECT_NEAR(carried_around<TypeParam>({60.0, 1000.0, 5.0}, false), 1.0, 0.01);
}

// Its velocity counts in the speed at which the two come together.
TYPED_TEST(MovingObstacle, StrikesABodyAtRestAtItsOwnSpeed) {
  constexpr int dim = TypeParam::dim;
  Scene<dim> scene = platform<dim>(path<dim>(1.0, 0.0));
  scene.world.gravity = 0.0;
  const auto world = TypeParam::make(scene.world);
  BodyDef<dim> cube;
  cube.pose.position = up<dim>(2.7);
  world->add(cube);
  world->record_contacts(true);
  double fastest = 0.0;
  for (int step = 0; step < 30; ++step) {
    Pose<dim> next = world->obstacle_pose(0);
    next.position += up<dim>(1.0 / 60.0);
    world->move_obstacle(0, next);
    world->step();
    for (const Contact<dim>& contact : world->contacts()) fastest = std::max(fastest, contact.approach_speed);
  }
  EXPECT_NEAR(fastest, 1.0, 1e-3);
}

TYPED_TEST(MovingObstacle, GivesTheSameBitsInEachRun) {
  constexpr int dim = TypeParam::dim;
  const auto hash = [] {
    auto simulation = simulation_on<TypeParam>(
        platform<dim>(fmt::format("{{kind = \"sine\", amplitude = {}, frequency = 1.5}}", vector_text<dim>(0.4, 0.1))));
    run_until(simulation, 4.0);
    return state_hash(simulation.world().states());
  };
  EXPECT_EQ(hash(), hash());
}

TYPED_TEST(MovingObstacle, DoesNotMoveOnceItIsRemoved) {
  constexpr int dim = TypeParam::dim;
  Scene<dim> scene = platform<dim>(path<dim>(1.0, 0.0));
  const auto world = TypeParam::make(scene.world);
  BodyDef<dim> cube;
  cube.pose.position = up<dim>(5.0);
  world->add(cube);
  Pose<dim> next = world->obstacle_pose(0);
  const Pose<dim> before = next;
  next.position += up<dim>(0.1);
  world->move_obstacle(0, next);
  world->remove_obstacle(0);
  world->step();
  world->restore_obstacle(0, before);
  world->step();
  EXPECT_TRUE(world->obstacle_pose(0).position.isApprox(before.position, 0.0));
}

TYPED_TEST(MovingObstacle, OfSeveralPiecesHoldsABodyWhereItIsPutBack) {
  constexpr int dim = TypeParam::dim;
  const std::vector<Vec2> bench = {{-2, 0}, {-0.2, 0}, {0, 0.2}, {0.2, 0}, {2, 0}, {2, 1}, {-2, 1}};
  const std::vector<Vec2> notched = {{-0.5, 0}, {0.5, 0}, {0.5, 0.5}, {0.1, 0.5}, {0, 0.4}, {-0.1, 0.5}, {-0.5, 0.5}};
  WorldDescription<dim> description = platform<dim>(path<dim>(1.0, 0.0)).world;
  description.shapes = {make_shape<dim>("notched", polygon_pieces<dim>(notched, 1.0), {.friction = 0.8})};
  description.obstacles = {
      {make_shape<dim>("bench", polygon_pieces<dim>(bench, 4.0), {.friction = 0.8}), {.position = up<dim>(5.0)}}};
  const auto world = TypeParam::make(description);
  const auto low = [&] { return height<dim>(world->bounds_of(0).min()); };
  const auto top = [&] { return height<dim>(bounds_at(world->obstacle_shape(0), world->obstacle_pose(0)).max()); };
  const auto run = [&](int steps) {
    for (int i = 0; i < steps; ++i) world->step();
  };
  world->add({.pose = {.position = up<dim>(6.0)}});
  run(120);
  EXPECT_NEAR(low(), top(), 0.03);
  world->remove_obstacle(0);
  run(1);
  world->restore_obstacle(0, {.position = up<dim>(3.0)});
  run(120);
  EXPECT_NEAR(low(), top(), 0.03);
}

TYPED_TEST(MovingObstacle, ThatComesBackLowerDoesNotHoldTheBodyThatSleptOnIt) {
  constexpr int dim = TypeParam::dim;
  const WorldDescription<dim> description = platform<dim>(path<dim>(1.0, 0.0)).world;
  const auto world = TypeParam::make(description);
  const Pose<dim> before = world->obstacle_pose(0);
  const BodyIndex cube = world->add({.pose = {.position = up<dim>(2.5)}});
  for (int i = 0; i < 120; ++i) world->step();
  world->freeze(std::vector<BodyIndex>{cube});
  world->remove_obstacle(0);
  world->restore_obstacle(0, {.position = before.position - up<dim>(0.015)});
  world->thaw(std::vector<BodyIndex>{cube});
  world->step();
  EXPECT_NEAR(height<dim>(world->states().velocity[cube]), -9.81 * world->dt(), 0.01);
}

TYPED_TEST(MovingObstacle, IsTheOnlyKindThatMoves) {
  constexpr int dim = TypeParam::dim;
  Scene<dim> scene = platform<dim>(path<dim>(1.0, 0.0));
  scene.world.obstacles[0].moves = false;
  const auto world = TypeParam::make(scene.world);
  EXPECT_THROW(world->move_obstacle(0, {}), std::invalid_argument);
  EXPECT_THROW(world->move_obstacle(1, {}), std::invalid_argument);
}

TYPED_TEST(MovingObstacle, KeepsARunThatEndsAtRestFromEnding) {
  constexpr int dim = TypeParam::dim;
  for (const char* policy : {"full", "adaptive", "engine"}) {
    if (!has_policy<TypeParam>(policy)) continue;
    SCOPED_TRACE(policy);
    auto simulation = simulation_on<TypeParam>(platform<dim>(
        path<dim>(1.0, 0.0), fmt::format("run = {{until = \"rest\", frames = 600}}\npolicy.kind = \"{}\"", policy)));
    while (!simulation.finished()) simulation.step();
    EXPECT_TRUE(simulation.at_rest());
    EXPECT_GT(simulation.time(), 4.0);
    EXPECT_LT(simulation.time(), 10.0);
  }
}

TYPED_TEST(MovingObstacle, KeepsARunFromEndingThoughOneOfItsPiecesIsGone) {
  constexpr int dim = TypeParam::dim;
  auto scene = platform<dim>(path<dim>(1.0, 0.0), "run = {until = \"rest\", frames = 600}");
  scene.world.obstacles.insert(scene.world.obstacles.begin(), scene.world.obstacles[0]);
  scene.world.obstacles[0].pose.position += up<dim>(50.0);
  scene.movers[0].count = 2;
  auto simulation = simulation_on<TypeParam>(scene);
  simulation.cut_obstacle(0);
  while (!simulation.finished()) simulation.step();
  EXPECT_GT(simulation.time(), 4.0);
}

TYPED_TEST(MovingObstacle, IsNotNeededForTheEndAtRest) {
  constexpr int dim = TypeParam::dim;
  auto scene = platform<dim>(path<dim>(1.0, 0.0), "run = {until = \"rest\", frames = 600}");
  scene.movers.clear();
  scene.bodies[0].def.pose.position += up<dim>(3.0);
  auto simulation = simulation_on<TypeParam>(scene);
  while (!simulation.finished()) simulation.step();
  EXPECT_TRUE(simulation.at_rest());
  EXPECT_GT(simulation.time(), 0.8) << "the fall alone takes as long";
  EXPECT_LT(simulation.time(), 8.0);
  scene.run.frames = 10;
  auto cut = simulation_on<TypeParam>(scene);
  while (!cut.finished()) cut.step();
  EXPECT_FALSE(cut.at_rest());
}

}  // namespace
}  // namespace talus::moving_obstacles_test

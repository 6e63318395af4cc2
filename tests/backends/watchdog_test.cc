// Each kind of warning on each engine, and none where a run is sound.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "common/policy/sleep_policy.h"
#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "tests/backends/backend.h"

namespace talus::watchdog_on_engines_test {
namespace {

namespace fs = std::filesystem;

template <typename Backend>
class WatchedRun : public BackendTest<Backend> {
 protected:
  static constexpr int dim = Backend::dim;

  static Scene<dim> scene() {
    Scene<dim> scene;
    scene.world = BackendTest<Backend>::description();
    scene.policy.kind = "full";
    return scene;
  }

  /// The warnings of so many steps.
  static std::vector<Warning> warnings(const Scene<dim>& scene, std::int64_t steps,
                                       const BodyDef<dim>* body = nullptr) {
    auto simulation = simulation_on<Backend>(scene);
    Watcher<dim> watcher;
    simulation.add_observer(watcher);
    if (body != nullptr) simulation.add(*body);
    for (std::int64_t i = 0; i < steps; ++i) simulation.step();
    simulation.end("finished");
    return {simulation.warnings().begin(), simulation.warnings().end()};
  }

  static bool has(const std::vector<Warning>& warnings, WarningKind kind) {
    return std::ranges::any_of(warnings, [&](const Warning& warning) { return warning.kind == kind; });
  }

  /// Boards of 0.1 m, 0.3 m apart, and a ball of twice their density that comes from so far away; nothing else acts.
  static Scene<dim> row(int boards, double away, double speed) {
    Scene<dim> scene;
    scene.policy.kind = "full";
    scene.world.gravity = 0.0;
    scene.world.ground.present = false;
    Vec<dim> board = Vec<dim>::Ones();
    board[0] = dim == 2 ? 0.01 : 0.05;  // on Box2D thicker boards stop every ball; Bullet takes none below
    scene.world.shapes = {make_shape<dim>("ball", ball_pieces<dim>(0.15), {.density = 2000.0}),
                          make_shape<dim>("board", box_pieces<dim>(board), {})};
    scene.bodies.resize(boards + 1);
    scene.bodies[0].def.pose.position[0] = -away;
    scene.bodies[0].def.velocity[0] = speed;
    for (int i = 1; i <= boards; ++i) {
      scene.bodies[i].def.shape = 1;
      scene.bodies[i].def.pose.position[0] = 0.3 * (i - 1);
    }
    return scene;
  }

  /// A box between a wall that stands and one that comes closer at `speed` [m/s] until two fifths of its width are
  /// left.
  static Scene<dim> press(double speed) {
    const bool flat = dim == 2;
    const std::string place = flat ? "[{}, 1]" : "[{}, 0, 1]";
    const std::string wall =
        fmt::format("[[obstacle]]\nkind = \"box\"\nsize = {}\nposition = ", flat ? "[1, 2]" : "[1, 4, 2]");
    const std::string text = fmt::format(
        "title = \"Press\"\ndimension = {}\npolicy.kind = \"full\"\nrun = {{frames = 9000}}\n"
        "shape.box = {{kind = \"box\", size = {}, friction = 0.5}}\nbody = [{{position = {}}}]\n{}{}\n{}{}\n"
        "motion = {{kind = \"path\", times = [1, {}], shifts = [{}, {}]}}\n",
        dim, flat ? "[1, 1]" : "[1, 1, 1]", flat ? "[0, 0.505]" : "[0, 0, 0.505]", wall,
        fmt::format(fmt::runtime(place), 1.03), wall, fmt::format(fmt::runtime(place), -1.03), 1.0 + 0.66 / speed,
        flat ? "[0, 0]" : "[0, 0, 0]", flat ? "[0.66, 0]" : "[0.66, 0, 0]");
    return std::get<Scene<dim>>(parse_scene(text, "text"));
  }

  /// What the engines' solver truly does at a scene's settings, as docs/limits.md says.
  static bool is_known(const std::string& scene, WarningKind kind) {
    if (scene == "silo_2d.toml" && (kind == WarningKind::energy || kind == WarningKind::speed_limit)) return true;
    const auto overlapping = {"box2d_tumbler_2d.toml", "silo_2d.toml", "ten_thousand_3d.toml"};
    if (kind == WarningKind::passed && dim == 3 && scene.starts_with("bunny_matrices")) return true;
    return (kind == WarningKind::overlap || kind == WarningKind::passed) && std::ranges::count(overlapping, scene) > 0;
  }

  /// Every shipped scene that is not of a million bodies, and the public ones in which something moves. Bullet in the
  /// plane presses L shapes of ten_thousand_2d into the ground, at the worst 0.3 m, so its warning there is right.
  static void expect_silence(std::int64_t frames) {
    const fs::path folder = fs::path(TALUS_SOURCE_DIR) / "scenes";
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    for (const char* name : {"box2d_tumbler_2d.toml", "drum_2d.toml", "hopper_2d.toml", "silo_2d.toml"})
      files.push_back(folder / "public" / name);
    for (const fs::path& file : files) {
      const std::string name = file.filename().string();
      if (name == "ten_thousand_2d.toml" && std::string_view(Backend::name) == "bullet_planar") continue;
      if (!name.ends_with(dim == 2 ? "_2d.toml" : "_3d.toml") || name.starts_with("million")) continue;
      for (const char* policy : {"full", "adaptive"}) {
        SCOPED_TRACE(name + " " + policy);
        auto scene = std::get<Scene<dim>>(read_scene(file));
        scene.policy.kind = policy;
        for (const Warning& warning : warnings(scene, frames * scene.steps_per_frame()))
          if (!is_known(name, warning.kind)) ADD_FAILURE() << advice(warning);
      }
    }
  }
};

TYPED_TEST_SUITE(WatchedRun, Backends, BackendName);

TYPED_TEST(WatchedRun, WarnsOfABodyBelowTheGround) {
  const auto scene = TestFixture::scene();
  const auto body = TestFixture::at(up<TypeParam::dim>(-0.4));
  EXPECT_TRUE(TestFixture::has(TestFixture::warnings(scene, 1, &body), WarningKind::below_ground));
}

TYPED_TEST(WatchedRun, WarnsOfABodyThatIsThrownOutOfTheWorld) {
  auto scene = TestFixture::scene();
  scene.world.gravity = 0.0;
  auto body = TestFixture::at(up<TypeParam::dim>(5.0));
  body.pose.position[0] = 9'990.0;
  body.velocity[0] = 100.0;
  EXPECT_FALSE(TestFixture::has(TestFixture::warnings(scene, 3, &body), WarningKind::outside_world));
  EXPECT_TRUE(TestFixture::has(TestFixture::warnings(scene, 12, &body), WarningKind::outside_world));
}

TYPED_TEST(WatchedRun, WarnsOfAFallThatReachesTheSpeedLimit) {
  auto scene = TestFixture::scene();
  scene.world.gravity = 400.0;
  const double limit = TypeParam::make(scene.world)->speed_limits().speed;
  const double steps = limit / scene.world.gravity / scene.world.dt;
  const auto body = TestFixture::at(up<TypeParam::dim>(5'000.0));
  EXPECT_TRUE(TestFixture::warnings(scene, std::lround(0.9 * steps), &body).empty());
  EXPECT_TRUE(
      TestFixture::has(TestFixture::warnings(scene, std::lround(1.2 * steps), &body), WarningKind::speed_limit));
}

TYPED_TEST(WatchedRun, WarnsOfABodyAtTheSpinLimit) {
  const auto scene = TestFixture::scene();
  auto body = TestFixture::at(up<TypeParam::dim>(50.0), 1);
  body.spin[0] = TypeParam::make(scene.world)->speed_limits().spin;
  EXPECT_TRUE(TestFixture::has(TestFixture::warnings(scene, 1, &body), WarningKind::spin_limit));
}

// The engines' own solvers create energy in bounces without end; small steps do not.
TYPED_TEST(WatchedRun, WarnsOfEnergyThatTheSolverCreates) {
  auto scene = TestFixture::scene();
  scene.world.gravity = 9.81;
  scene.world.solver.restitution_threshold = 0.0;
  scene.world.ground.material.restitution = 1.0;
  scene.world.shapes = {make_shape<TypeParam::dim>("ball", ball_pieces<TypeParam::dim>(0.5), {.restitution = 1.0})};
  scene.sources.resize(1);
  scene.sources[0].count = 5;
  scene.sources[0].position = up<TypeParam::dim>(12.0);
  EXPECT_EQ(TestFixture::has(TestFixture::warnings(scene, 10'000), WarningKind::energy), !has_small_steps<TypeParam>);
}

// What is pressed between two walls has no way out: it sinks into them, or the engine throws it out.
TYPED_TEST(WatchedRun, WarnsOfABodyThatIsPressedIntoWalls) {
  const auto scene = TestFixture::press(0.05);
  const auto warnings = TestFixture::warnings(scene, 16 * 60);
  EXPECT_TRUE(TestFixture::has(warnings, WarningKind::overlap) || TestFixture::has(warnings, WarningKind::energy));
}

// A board that is struck may be driven through the next one within the step. Where the order of a row has changed, a
// body has got past another one.
TYPED_TEST(WatchedRun, WarnsWhereAFastBodyGetsPastAnother) {
  constexpr int boards = 5;
  int passed = 0;
  for (const double speed : {5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 60.0, 80.0, 110.0}) {
    for (int phase = 0; phase < 10; ++phase) {
      Scene<TypeParam::dim> scene = TestFixture::row(boards, 2.0 + phase * speed / 600.0, speed);
      auto simulation = simulation_on<TypeParam>(scene);
      Watcher<TypeParam::dim> watcher;
      simulation.add_observer(watcher);
      for (int step = 0; step < 60; ++step) simulation.step();
      const auto& poses = simulation.world().states().pose;
      if (std::ranges::is_sorted(poses, {}, [](const auto& pose) { return pose.position[0]; })) continue;
      ++passed;
      EXPECT_TRUE(TestFixture::has({simulation.warnings().begin(), simulation.warnings().end()}, WarningKind::passed))
          << speed << " m/s, phase " << phase;
    }
  }
  EXPECT_GT(passed, 0);
}

TYPED_TEST(WatchedRun, IsSilentWhereFastBodiesStopAtEachOther) {
  for (const double speed : {5.0, 20.0, 60.0}) {
    auto scene = TestFixture::row(1, 2.0, speed);
    EXPECT_TRUE(TestFixture::warnings(scene, 60).empty()) << speed << " m/s";
  }
}

TYPED_TEST(WatchedRun, IsSilentOverABounceThatLosesEnergy) {
  auto scene = TestFixture::scene();
  scene.world.ground.material.restitution = 0.8;
  scene.world.shapes = {make_shape<TypeParam::dim>("ball", ball_pieces<TypeParam::dim>(0.5), {.restitution = 0.8})};
  const auto body = TestFixture::at(up<TypeParam::dim>(12.0));
  EXPECT_TRUE(TestFixture::warnings(scene, 2'000, &body).empty());
}

TYPED_TEST(WatchedRun, WarnsOfBodiesThatTheirSourceNeverFoundRoomFor) {
  auto scene = TestFixture::scene();
  scene.sources.resize(1);
  scene.sources[0].count = 4;
  scene.sources[0].rate = 10.0;
  scene.sources[0].position = up<TypeParam::dim>(0.8);
  scene.sources[0].orientation = identity_rotation<TypeParam::dim>();
  const std::vector<Warning> warnings = TestFixture::warnings(scene, 200);
  ASSERT_TRUE(TestFixture::has(warnings, WarningKind::not_appeared));
  EXPECT_EQ(warnings.back().bodies, 3);
}

template <typename Backend>
class ShippedScenes : public WatchedRun<Backend> {};
TYPED_TEST_SUITE(ShippedScenes, SmallStepsBackends, BackendName);

// Two seconds: in each scene bodies have landed.
TYPED_TEST(ShippedScenes, GiveNoWarning) { TestFixture::expect_silence(60); }

template <typename Backend>
class LongShippedScenes : public WatchedRun<Backend> {};

TYPED_TEST_SUITE(LongShippedScenes, SmallStepsBackends, BackendName);

TYPED_TEST(LongShippedScenes, GiveNoWarning) { TestFixture::expect_silence(200); }

}  // namespace
}  // namespace talus::watchdog_on_engines_test

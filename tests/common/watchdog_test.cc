#include "common/simulation/watchdog.h"

#include <gtest/gtest.h>

#include "common/shape/catalogue.h"
#include "tests/common/falling_world.h"

namespace talus::watchdog_test {
namespace {

constexpr double gravity = 10.0;
constexpr double dt = 1.0 / 60.0;

template <int Dim>
Scene<Dim> scene() {
  Scene<Dim> scene;
  scene.world.gravity = gravity;
  scene.world.dt = dt;
  scene.world.shapes = {make_shape<Dim>("ball", ball_pieces<Dim>(0.5), {})};
  return scene;
}

/// A world of falling balls that is looked at after each step.
class Watch {
 public:
  explicit Watch(const SpeedLimits& limits = {}) : dog_(scene_, limits) {}

  BodyIndex add(double x, double height, const Vec2& velocity = Vec2::Zero()) {
    BodyDef<2> body;
    body.pose.position = {x, height};
    body.velocity = velocity;
    return world.add(body);
  }
  void step(int steps = 1) {
    for (int i = 0; i < steps; ++i) {
      world.step();
      check();
    }
  }
  void check() {
    dog_.check(world, events_, ++step_);
    events_.clear();
  }
  void freeze(BodyIndex body) {
    world.freeze(std::vector<BodyIndex>{body});
    events_.push_back({.body = body, .woke = false});
  }
  std::span<const Warning> warnings() const { return dog_.warnings(); }
  Watchdog<2>& dog() { return dog_; }

 private:
  Scene<2> scene_ = scene<2>();

 public:
  FallingWorld<2> world{scene_.world};

 private:
  Watchdog<2> dog_;
  std::vector<SleepEvent> events_;
  std::int64_t step_ = 0;
};

TEST(Watchdog, IsSilentWhileBodiesFallAndComeToRest) {
  Watch watch;
  for (int i = 0; i < 5; ++i) watch.add(i, 3.0 + i);
  watch.step(200);
  EXPECT_TRUE(watch.warnings().empty());
}

TEST(Watchdog, CountsEachBodyBelowTheGroundOnceWithItsFirstStep) {
  Watch watch;
  watch.add(0.0, 5.0);
  watch.add(2.0, -0.2);  // the world lifts it to 0.5 in its first step
  watch.dog().check(watch.world, {}, 1);
  watch.dog().check(watch.world, {}, 2);
  ASSERT_EQ(watch.warnings().size(), 1U);
  EXPECT_EQ(watch.warnings()[0].kind, WarningKind::below_ground);
  EXPECT_EQ(watch.warnings()[0].step, 1);
  EXPECT_EQ(watch.warnings()[0].body, 1);
  EXPECT_EQ(watch.warnings()[0].bodies, 1);
  EXPECT_NEAR(watch.warnings()[0].value, 0.2, 1e-12);
}

TEST(Watchdog, AllowsTheGapThatEnginesKeepInContact) {
  Watch watch;
  watch.add(0.0, -0.009);
  watch.dog().check(watch.world, {}, 1);
  EXPECT_TRUE(watch.warnings().empty());
}

TEST(Watchdog, SeesABodyThatIsFrozenBelowTheGround) {
  Watch watch;
  const BodyIndex body = watch.add(0.0, -0.3);
  watch.freeze(body);
  watch.check();
  ASSERT_EQ(watch.warnings().size(), 1U);
  EXPECT_EQ(watch.warnings()[0].kind, WarningKind::below_ground);
}

TEST(Watchdog, SeesABodyThatLeavesTheWorld) {
  Watch watch;
  watch.add(9'999.5, 5.0, Vec2(100.0, 0.0));
  watch.step(1);
  ASSERT_EQ(watch.warnings().size(), 1U);
  EXPECT_EQ(watch.warnings()[0].kind, WarningKind::outside_world);
  EXPECT_NEAR(watch.warnings()[0].value, 9'999.5 + 100.0 * dt, 1e-6);
}

TEST(Watchdog, SeesABodyAtTheSpeedLimitAndNoneBelowIt) {
  Watch watch({.speed = 20.0, .spin = 5.0});
  watch.add(0.0, 100.0, Vec2(0.0, -19.5));
  watch.step(1);
  EXPECT_TRUE(watch.warnings().empty());
  watch.step(3);
  ASSERT_EQ(watch.warnings().size(), 1U);
  EXPECT_EQ(watch.warnings()[0].kind, WarningKind::speed_limit);
  EXPECT_EQ(watch.warnings()[0].step, 3);
}

TEST(Watchdog, SeesABodyAtTheSpinLimit) {
  Watch watch({.speed = 20.0, .spin = 5.0});
  BodyDef<2> body;
  body.pose.position = {0.0, 5.0};
  body.spin[0] = -5.0;
  watch.world.add(body);
  watch.step(1);
  ASSERT_EQ(watch.warnings().size(), 1U);
  EXPECT_EQ(watch.warnings()[0].kind, WarningKind::spin_limit);
}

/// Ten bodies are planned, two a second; one appears at once and one after `second` steps, each of which blocks the
/// place of the next one. By hand come ten more.
std::vector<Warning> warnings_of_a_pour(std::int64_t second, std::int64_t end) {
  Scene<2> planned = scene<2>();
  planned.sources.resize(1);
  planned.sources[0].count = 10;
  planned.sources[0].rate = 2.0;
  Watchdog<2> dog(planned, {});
  FallingWorld<2> world(planned.world);
  Emitter<2> emitter(planned);
  const Pose<2> aside{.position = Vec2(100.0, 0.0)};
  emitter.emit(world, 0.0);
  world.move(0, aside);
  emitter.emit(world, static_cast<double>(second) * dt);
  for (int i = 0; i < 10; ++i) world.add({.pose = aside});
  EXPECT_EQ(emitter.emitted(), 2);
  dog.finish(emitter, end);
  return {dog.warnings().begin(), dog.warnings().end()};
}

TEST(Watchdog, CountsBodiesThatAStalledSourceNeverAdded) {
  const std::vector<Warning> warnings = warnings_of_a_pour(30, 181);  // the last emission is at 3 s: 7 bodies are due
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].kind, WarningKind::not_appeared);
  EXPECT_EQ(warnings[0].bodies, 5);
}

TEST(Watchdog, IsSilentAboutALatePourThatTheEndOfTheRunCutsShort) { EXPECT_TRUE(warnings_of_a_pour(170, 181).empty()); }

TEST(Watchdog, CountsBodiesThatWereAllDueLongBeforeTheEnd) {
  const std::vector<Warning> warnings = warnings_of_a_pour(490, 500);  // the last one was due at 4.5 s
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].bodies, 8);
}

TEST(Watchdog, IsSilentAboutBodiesThatAreNotYetDue) {
  Scene<2> planned = scene<2>();
  planned.sources.resize(1);
  Watchdog<2> dog(planned, {});
  FallingWorld<2> world(planned.world);
  Emitter<2> emitter(planned);
  emitter.emit(world, 0.0);
  dog.finish(emitter, 5);
  EXPECT_TRUE(dog.warnings().empty());
}

TEST(Watchdog, CountsBodiesLostAtTheEnd) {
  Watch watch;
  watch.add(0.0, 5.0);
  watch.add(1.0, -1.0);
  for (const BodyIndex body : {2, 3}) {
    watch.add(0.0, 5.0);
    watch.world.move(body, {.position = Vec2(20'000.0, 5.0)});
  }
  watch.world.remove(3);
  EXPECT_EQ(bodies_lost(watch.world.states(), Ground{}), 2);
  Ground none;
  none.present = false;
  EXPECT_EQ(bodies_lost(watch.world.states(), none), 1);
}

}  // namespace
}  // namespace talus::watchdog_test

// What observers see of a world that a program simulates.
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "common/simulation/sleeper_watch.h"
#include "tests/sleeper/box2d_scene.h"

namespace talus::observe_test {
namespace {

using test::SleepingBox2dScene;

/// What the observer below has seen.
struct Seen {
  std::int64_t frames = 0;
  double time = 0.0;
  std::map<BodyIndex, bool> asleep;  // by the events
  std::vector<Shape<2>> shapes;
  std::vector<Obstacle<2>> obstacles;
  std::vector<Pose<2>> poses;
  std::int64_t removals = 0;
  std::string end;
};

class Keeper final : public Observer<2> {
 public:
  explicit Keeper(Seen& seen) : seen_(seen) {}
  void on_frame(const Frame<2>& frame) override {
    ++seen_.frames;
    seen_.time = frame.time;
    for (const SleepEvent& event : frame.events) seen_.asleep[event.body] = !event.woke;
    seen_.shapes.assign(frame.world.shapes().begin(), frame.world.shapes().end());
    seen_.obstacles.assign(frame.world.obstacles().begin(), frame.world.obstacles().end());
    seen_.poses = frame.world.states().pose;
    seen_.removals = frame.world.removals();
  }
  void on_end(const Frame<2>& /*last*/, std::string_view reason) override { seen_.end = reason; }

 private:
  Seen& seen_;
};

struct AnObservedWorld : ::testing::Test {
  Seen seen;
  SleepingBox2dScene scene;

  void observe() { scene.sleeper->observe(std::make_unique<Keeper>(seen)); }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) scene.step(test::drop_dt);
  }
};

TEST_F(AnObservedWorld, ShowsEachStepFromTheStateAtTheStartOn) {
  scene.drop({Vec2(0, 3), Rotation<2>(0)});
  observe();
  EXPECT_EQ(seen.frames, 1);
  run(30);
  EXPECT_EQ(seen.frames, 31);
  EXPECT_NEAR(seen.time, 30 * test::drop_dt, 1e-12);
}

TEST_F(AnObservedWorld, TellsEachChangeOfSleepAlsoThoseBetweenSteps) {
  auto& box = scene.drop({Vec2(0, 0.4), Rotation<2>(0)});
  observe();
  const auto number = [&] {
    BodyIndex body = 0;
    while (!(scene.sleeper->core().handle_of(body) == scene.sleeper->handle(box))) ++body;
    return body;
  }();
  run(200);
  ASSERT_TRUE(scene.sleeper->asleep(box));
  EXPECT_TRUE(seen.asleep.at(number));
  scene.sleeper->wake(box);
  run(1);
  EXPECT_FALSE(seen.asleep.at(number));
}

TEST_F(AnObservedWorld, HasEachDistinctShapeOnce) {
  observe();
  for (int i = 0; i < 5; ++i) scene.drop({Vec2(2 * i, 3), Rotation<2>(0.1 * i)});
  run(1);
  EXPECT_EQ(seen.shapes.size(), 1U);
  scene.sleeper->add(scene.add_box({0.5, 0.25}, {0, 8}, b2_dynamicBody));
  run(1);
  ASSERT_EQ(seen.shapes.size(), 2U);
  EXPECT_NEAR(seen.shapes[1].mass, 125.0, 1e-4);  // [kg]: 1000 kg/m^2 x 0.5 m x 0.25 m, in single precision
  EXPECT_TRUE(std::holds_alternative<HullPiece<2>>(seen.shapes[1].pieces.at(0)));
}

TEST_F(AnObservedWorld, HasTheTrueShapesOfBodiesThatWereThereBefore) {
  auto& sleeper = scene.drop({Vec2(0, 0.4), Rotation<2>(0)});
  run(200);
  ASSERT_TRUE(scene.sleeper->asleep(sleeper));
  scene.drop({Vec2(5, 3), Rotation<2>(0)});
  observe();
  const auto& pieces = seen.shapes.back().pieces;  // one shape, whether it sleeps or not
  EXPECT_EQ(seen.shapes.size(), 2U);               // and their box
  ASSERT_TRUE(std::holds_alternative<HullPiece<2>>(pieces.at(0)));
  EXPECT_EQ(std::get<HullPiece<2>>(pieces.at(0)).corners.size(), 4U);
}

TEST_F(AnObservedWorld, HasStaticAndKinematicBodiesAsObstaclesWhereTheyAre) {
  auto& lift = scene.add_lift({3, 1}, {6, 0.5});
  observe();
  ASSERT_EQ(seen.obstacles.size(), 2U);
  for (int i = 0; i < 60; ++i) {
    scene.move_lift(lift, {6, 0.5 + 0.01 * (i + 1)}, test::drop_dt);
    run(1);
  }
  const auto moving = std::ranges::find_if(seen.obstacles, &Obstacle<2>::moves);
  ASSERT_NE(moving, seen.obstacles.end());
  EXPECT_NEAR(moving->pose.position.y(), lift.GetPosition().y, 1e-5);  // single precision
  EXPECT_NEAR(moving->pose.position.y(), 1.1, 1e-3);
}

/// Its fixture lies beside its origin.
TEST_F(AnObservedWorld, HasASleepingBodyAtItsCentreOfMassAlsoOnceItIsLoaded) {
  b2BodyDef def;
  def.type = b2_dynamicBody;
  b2PolygonShape shape;
  shape.SetAsBox(0.5F, 0.3F, {1.0F, 0.3F}, 0.0F);
  b2Body& body = *scene.world.CreateBody(&def);
  body.CreateFixture(&shape, 1000.0F);
  scene.sleeper->add(body);
  observe();
  run(200);
  ASSERT_TRUE(scene.sleeper->asleep(body));
  EXPECT_NEAR(seen.poses.at(0).position.x(), 1.0, 1e-3);
  scene.sleeper->restore(scene.sleeper->snapshot());
  run(1);
  ASSERT_TRUE(scene.sleeper->asleep(body));
  EXPECT_NEAR(seen.poses.at(0).position.x(), 1.0, 1e-3);
}

TEST_F(AnObservedWorld, CountsTheBodiesThatLeave) {
  auto& box = scene.drop({Vec2(0, 3), Rotation<2>(0)});
  observe();
  scene.take_away(box);
  scene.drop({Vec2(5, 3), Rotation<2>(0)});
  run(1);
  EXPECT_EQ(seen.removals, 1);
  EXPECT_NEAR(seen.poses.at(0).position.x(), 5.0, 1e-6);  // the newcomer has the number of the one that left
}

TEST_F(AnObservedWorld, EndsWithTheSleeperOrBefore) {
  observe();
  run(1);
  scene.sleeper->end_observers();
  EXPECT_EQ(seen.end, "finished");
  run(1);
  EXPECT_EQ(seen.frames, 2);
}

TEST_F(AnObservedWorld, EndsForEachObserverThoughOneFails) {
  struct Failing final : Observer<2> {
    void on_frame(const Frame<2>& /*frame*/) override {}
    void on_end(const Frame<2>& /*last*/, std::string_view /*reason*/) override {
      throw std::runtime_error("disk full");
    }
  };
  scene.sleeper->observe(std::make_unique<Failing>());
  observe();
  EXPECT_THROW(scene.sleeper->end_observers(), std::runtime_error);
  EXPECT_EQ(seen.end, "finished");
}

TEST_F(AnObservedWorld, CarriesOutTheChangesOfAStepInWhichAnObserverFails) {
  struct Failing final : Observer<2> {
    void on_frame(const Frame<2>& frame) override {
      if (!frame.events.empty()) throw std::runtime_error("disk full");
    }
  };
  auto& box = scene.drop({Vec2(0, 0.4), Rotation<2>(0)});
  scene.sleeper->observe(std::make_unique<Failing>());
  int steps = 0;
  while (!scene.sleeper->asleep(box) && steps++ < 400) run(1);
  ASSERT_TRUE(scene.sleeper->asleep(box));
  EXPECT_THROW(run(1), std::runtime_error);
  EXPECT_NO_THROW(run(1));
  EXPECT_NEAR(box.GetPosition().y, 0.3F, 0.05F) << "it was frozen in the engine too";
}

TEST(AnObserver, IsRefusedWhereNoBodyMaySleep) {
  b2World world(b2Vec2(0, -10));
  Box2dSleeper sleeper(world, {.enabled = false});
  EXPECT_THROW(sleeper.observe(std::make_unique<SleeperWatch<2>>()), InvalidValue);
}

/// A disc of 0.2 m flies at 100 m/s into a plate of 0.2 m; Box2D sweeps no dynamic body against another.
TEST(AWatchedWorld, WarnsOnceOfABodyThatGetsThroughAnother) {
  b2World world(b2Vec2(0, 0));
  b2BodyDef def;
  def.type = b2_dynamicBody;
  b2Body& plate = *world.CreateBody(&def);
  b2PolygonShape box;
  box.SetAsBox(0.1F, 2.0F);
  plate.CreateFixture(&box, 1000.0F);
  def.position = {-2.9F, 0.0F};
  b2Body& disc = *world.CreateBody(&def);
  b2CircleShape circle;
  circle.m_radius = 0.1F;
  disc.CreateFixture(&circle, 1000.0F);
  disc.SetLinearVelocity({100.0F, 0.0F});
  Box2dSleeper sleeper(world);
  sleeper.add_all();
  std::vector<Warning> warnings;
  sleeper.observe(std::make_unique<SleeperWatch<2>>([&](const Warning& warning) { warnings.push_back(warning); }));
  for (int i = 0; i < 6; ++i) {
    sleeper.before_step();
    world.Step(1.0F / 60.0F, 8, 3);
    sleeper.after_step(1.0 / 60.0);
  }
  ASSERT_GT(disc.GetPosition().x, 1.0F);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].kind, WarningKind::passed);
  EXPECT_EQ(&sleeper.body(sleeper.core().handle_of(warnings[0].body)), &disc);
  EXPECT_NEAR(warnings[0].value, 100.0 / 60.0, 1e-3);
}

/// Put elsewhere is no way through what lies between.
TEST(AWatchedWorld, DoesNotWarnOfATeleportedBody) {
  SleepingBox2dScene scene;
  auto& box = scene.drop({Vec2(-3, 2), Rotation<2>(0)});
  scene.drop({Vec2(0, 2), Rotation<2>(0)});
  int warnings = 0;
  scene.sleeper->observe(std::make_unique<SleeperWatch<2>>([&](const Warning&) { ++warnings; }));
  for (int i = 0; i < 5; ++i) scene.step(test::drop_dt);
  scene.put(box, {3, 2});
  for (int i = 0; i < 5; ++i) scene.step(test::drop_dt);
  EXPECT_EQ(warnings, 0);
}

}  // namespace
}  // namespace talus::observe_test

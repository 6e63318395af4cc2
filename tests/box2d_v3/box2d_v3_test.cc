#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/box2d_v3/box2d_v3_scene.h"
#include "tests/sleeper/drum.h"
#include "tests/sleeper/game.h"
#include "tests/sleeper/pour.h"
#include "tests/sleeper/stack.h"

namespace talus::test {
namespace {

using SleepingBox2dV3Stack = SleepingStack<SleepingBox2dV3Scene>;
INSTANTIATE_TYPED_TEST_SUITE_P(Box2dV3, SleepingStack, SleepingBox2dV3Scene);

TEST_F(SleepingBox2dV3Stack, IsStaticToBox2dUntilItWakes) {
  ASSERT_EQ(asleep(), 4);
  for (const auto* body : stack) EXPECT_EQ(b2Body_GetType(*body), b2_staticBody);
  scene.sleeper->wake_all();
  for (const auto* body : stack) {
    EXPECT_EQ(b2Body_GetType(*body), b2_dynamicBody);
    EXPECT_EQ(b2Body_GetMass(*body), 600.0F);
  }
}

/// Its contacts begin without impulses, so it sinks by what gravity gives within the first substeps: 2.5 mm were
/// measured, a thousandth of its height.
TEST_F(SleepingBox2dV3Stack, SinksByAThousandthOfItsHeightWhenItWakes) {
  const double top = height_of(3);
  scene.sleeper->wake_all();
  for (int i = 0; i < 30; ++i) {
    scene.step_engine();
    EXPECT_NEAR(height_of(3), top, 3e-3);
  }
}

TEST_F(SleepingBox2dV3Stack, KeepsTheMassThatTheProgramSet) {
  scene.sleeper->wake(*stack.back());
  b2MassData heavy = b2Body_GetMassData(*stack.back());
  heavy.mass *= 3.0F;
  heavy.rotationalInertia *= 3.0F;
  b2Body_SetMassData(*stack.back(), heavy);
  scene.run(240);
  ASSERT_TRUE(scene.sleeper->asleep(*stack.back()));
  scene.sleeper->wake(*stack.back());
  EXPECT_EQ(b2Body_GetMass(*stack.back()), 1800.0F);
}

/// Box2D gives the number of a removed body to the next one, with another generation.
TEST_F(SleepingBox2dV3Stack, IsNotTakenForTheBodyThatGetsItsNumber) {
  const b2BodyId old = *stack.back();
  scene.take_away(*stack.back());
  const b2BodyId next = scene.drop(drops<2>(1, 1).front());
  EXPECT_EQ(next.index1, old.index1);
  EXPECT_FALSE(scene.sleeper->watches(old));
  EXPECT_TRUE(scene.sleeper->watches(next));
}

TEST(Box2dV3Sleeper, RefusesWhatItCannotWatch) {
  SleepingBox2dV3Scene scene;
  EXPECT_THROW(scene.sleeper->add(scene.ground), InvalidValue);
  const b2BodyId box = scene.drop(drops<2>(1, 1).front());
  EXPECT_THROW(scene.sleeper->add(box), InvalidValue);
  EXPECT_THROW(scene.sleeper->wake(scene.ground), InvalidValue);
  b2BodyDef def = b2DefaultBodyDef();
  def.type = b2_dynamicBody;
  EXPECT_THROW(scene.sleeper->add(b2CreateBody(scene.world, &def)), InvalidValue);  // without shapes
}

TEST(Box2dV3Sleeper, LeavesOutBodiesWithoutASolidShape) {
  SleepingBox2dV3Scene scene;
  b2BodyDef def = b2DefaultBodyDef();
  def.type = b2_dynamicBody;
  const std::array bodies = {b2CreateBody(scene.world, &def), b2CreateBody(scene.world, &def)};
  b2ShapeDef sensor = b2DefaultShapeDef();
  sensor.isSensor = true;
  const b2Circle circle = {{0.0F, 0.0F}, 0.5F};
  b2CreateCircleShape(bodies[1], &sensor, &circle);
  EXPECT_EQ(scene.sleeper->add_all(bodies), 0);
  EXPECT_EQ(scene.sleeper->size(), 0);
  for (const b2BodyId body : bodies) EXPECT_THROW(scene.sleeper->add(body), InvalidValue);
}

/// What observers see.
class Seen final : public Observer<2> {
 public:
  struct Last {
    int frames = 0;
    std::vector<Shape<2>> shapes;
    std::vector<Obstacle<2>> obstacles;
    std::vector<Vec2> places;
  };
  explicit Seen(Last& last) : last_(last) {}
  void on_frame(const Frame<2>& frame) override {
    ++last_.frames;
    last_.shapes.assign(frame.world.shapes().begin(), frame.world.shapes().end());
    last_.obstacles.assign(frame.world.obstacles().begin(), frame.world.obstacles().end());
    last_.places.clear();
    for (const Pose<2>& pose : frame.world.states().pose) last_.places.push_back(pose.position);
  }

 private:
  Last& last_;
};

TEST_F(SleepingBox2dV3Stack, IsSeenWithItsTrueShapesAndTheStaticBodiesThatAreNamed) {
  Seen::Last last;
  scene.sleeper->observe(std::make_unique<Seen>(last), std::array{scene.ground});
  const b2BodyId box = scene.add_box({1, 1}, {5, 3}, b2_dynamicBody);
  scene.sleeper->add(box);
  scene.run(30);
  EXPECT_EQ(last.frames, 31);  // the first is the state at the start
  ASSERT_EQ(last.obstacles.size(), 1U);
  EXPECT_NEAR(last.obstacles[0].pose.position.y(), -1.0, 1e-6);
  const auto& pieces = last.shapes.back().pieces;
  ASSERT_TRUE(std::holds_alternative<HullPiece<2>>(pieces.at(0)));
  EXPECT_EQ(std::get<HullPiece<2>>(pieces.at(0)).corners.size(), 4U);
  ASSERT_EQ(last.places.size(), 5U);
  EXPECT_NEAR(last.places[0].y(), height_of(0), 1e-6);
  EXPECT_NEAR(last.places[4].y(), b2Body_GetPosition(box).y, 1e-6);
  EXPECT_LT(last.places[4].y(), 2.9);
}

/// Its polygon lies beside its origin.
TEST(Box2dV3Sleeper, ShowsASleepingBodyAtItsCentreOfMassAlsoOnceItIsLoaded) {
  SleepingBox2dV3Scene scene;
  b2BodyDef def = b2DefaultBodyDef();
  def.type = b2_dynamicBody;
  const b2BodyId body = b2CreateBody(scene.world, &def);
  const b2ShapeDef shape = b2DefaultShapeDef();
  const b2Polygon box = b2MakeOffsetBox(0.5F, 0.3F, {1.0F, 0.3F}, b2Rot_identity);
  b2CreatePolygonShape(body, &shape, &box);
  scene.watch(body);
  Seen::Last last;
  scene.sleeper->observe(std::make_unique<Seen>(last));
  scene.run(200);
  ASSERT_TRUE(scene.sleeper->asleep(body));
  EXPECT_NEAR(last.places.at(0).x(), 1.0, 1e-3);
  scene.sleeper->restore(scene.sleeper->snapshot());
  scene.run(1);
  ASSERT_TRUE(scene.sleeper->asleep(body));
  EXPECT_NEAR(last.places.at(0).x(), 1.0, 1e-3);
}

TEST(Box2dV3Sleeper, ChangesNoBitWhenItIsOff) {
  SleepingBox2dV3Scene with({.enabled = false});
  Box2dV3Scene without;
  std::vector<b2BodyId> alone;
  const std::vector<Pose<2>> starts = drops<2>(60, 1);
  for (int step = 0; step < 900; ++step) {
    if (step % steps_between_drops == 0 && step / steps_between_drops < std::ssize(starts)) {
      with.drop(starts[step / steps_between_drops]);
      alone.push_back(without.add_drop(starts[step / steps_between_drops]));
    }
    with.step();
    without.step();
  }
  auto watched = with.bodies.begin();
  for (const b2BodyId body : alone) EXPECT_EQ(with.place(*watched++), with.place({body}));
}

class Box2dV3Game : public ::testing::TestWithParam<unsigned> {};
TEST_P(Box2dV3Game, LeavesNoBodyFloatingHangingOrLost) {
  Game<SleepingBox2dV3Scene> game(GetParam());
  ASSERT_EQ(game.play(400), "");
  expect_sound(game);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Box2dV3Game, ::testing::Range(1U, 9U));

class LongBox2dV3Game : public ::testing::TestWithParam<unsigned> {};
TEST_P(LongBox2dV3Game, LeavesNoBodyFloatingHangingOrLost) {
  Game<SleepingBox2dV3Scene> game(GetParam());
  ASSERT_EQ(game.play(10000), "");
  expect_sound(game);
}
INSTANTIATE_TEST_SUITE_P(Seeds, LongBox2dV3Game, ::testing::Range(101U, 103U));

/// Number of boxes, and of the seeds that they are poured with.
class LongBox2dV3PourCost : public ::testing::TestWithParam<std::pair<int, unsigned>> {};

TEST_P(LongBox2dV3PourCost, IsLessThanThatOfTheEngine) {
  expect_faster_pour<SleepingBox2dV3Scene>("Box2D 3.1", GetParam().first, GetParam().second);
}
INSTANTIATE_TEST_SUITE_P(Boxes, LongBox2dV3PourCost,
                         ::testing::Values(std::pair(300, 8U), std::pair(1000, 3U), std::pair(3000, 1U)));

/// A drum that turns.
class Box2dV3Drum {
 public:
  static std::string name() { return "Box2D 3.1"; }

  Box2dV3Drum(int boxes, bool attached) {
    b2DestroyBody(scene_.ground);
    const double radius = drum_radius(boxes);
    b2BodyDef def = b2DefaultBodyDef();
    def.type = b2_kinematicBody;
    def.angularVelocity = drum_spin;
    bodies_.push_back(b2CreateBody(scene_.world, &def));
    for (int i = 0; i < drum_sides; ++i) {
      const Pose<2> at = side(i, radius);
      const b2Polygon box =
          b2MakeOffsetBox(static_cast<float>(0.5 * wall), static_cast<float>(0.5 * side_length(radius)),
                          Box2dV3Scene::to_box2d(at.position), b2MakeRot(static_cast<float>(at.rotation.angle())));
      const b2ShapeDef shape = b2DefaultShapeDef();
      b2CreatePolygonShape(bodies_.front(), &shape, &box);
    }
    for (int i = 0; i < boxes; ++i) {
      bodies_.push_back(scene_.add_box({0.7, 0.42}, start(i, 15, radius), b2_dynamicBody));
      b2Body_EnableSleep(bodies_.back(), false);
    }
    if (attached) sleeper_.emplace(scene_.world).add_all(bodies_);
  }
  void step() {
    if (sleeper_) sleeper_->before_step();
    scene_.step();
    if (sleeper_) sleeper_->after_step(drop_dt, Box2dV3Scene::substeps);
  }
  std::vector<double> state() const {
    std::vector<double> numbers;
    for (const b2BodyId body : bodies_) {
      const b2Transform at = b2Body_GetTransform(body);
      numbers.insert(numbers.end(), {at.p.x, at.p.y, at.q.c, at.q.s});
    }
    return numbers;
  }
  int asleep() const { return sleeper_->size() - 1 - sleeper_->awake(); }

 private:
  Box2dV3Scene scene_;
  std::vector<b2BodyId> bodies_;
  std::optional<Box2dV3Sleeper> sleeper_;
};

class LongBox2dV3AwakeCost : public ::testing::TestWithParam<int> {};
// Its steps take a third of those of Box2D 2.4, and the sleeper as long.
TEST_P(LongBox2dV3AwakeCost, IsBelowAFifthInADrum) { expect_small_cost<Box2dV3Drum>(GetParam(), 0.2); }
INSTANTIATE_TEST_SUITE_P(Boxes, LongBox2dV3AwakeCost, ::testing::Values(300, 1000));

}  // namespace
}  // namespace talus::test

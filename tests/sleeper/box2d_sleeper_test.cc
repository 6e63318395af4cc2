#include <gtest/gtest.h>

#include "tests/sleeper/box2d_scene.h"
#include "tests/sleeper/stack.h"

namespace talus::test {
namespace {

using SleepingBox2dStack = SleepingStack<SleepingBox2dScene>;
INSTANTIATE_TYPED_TEST_SUITE_P(Box2d, SleepingStack, SleepingBox2dScene);

TEST_F(SleepingBox2dStack, IsStaticToBox2dUntilItWakes) {
  ASSERT_EQ(asleep(), 4);
  for (const b2Body* body : stack) EXPECT_EQ(body->GetType(), b2_staticBody);
  scene.sleeper->wake_all();
  for (const b2Body* body : stack) {
    EXPECT_EQ(body->GetType(), b2_dynamicBody);
    EXPECT_EQ(body->GetMass(), 600.0F);
    EXPECT_TRUE(body->IsAwake());
  }
}

/// The impulses of its contacts come back. Without them it would fall by g dt in the first step, 0.16 m/s; with them
/// its speed is a thousandth of that.
TEST_F(SleepingBox2dStack, StandsStillWhenItWakes) {
  scene.sleeper->wake_all();
  for (int i = 0; i < 30; ++i) {
    scene.step_engine();
    for (const b2Body* body : stack) EXPECT_LT(body->GetLinearVelocity().Length(), 2e-4F);
  }
}

TEST_F(SleepingBox2dStack, KeepsTheMassThatTheProgramSet) {
  scene.sleeper->wake(*stack.back());
  b2MassData heavy;
  stack.back()->GetMassData(&heavy);
  heavy.mass *= 3.0F;
  heavy.I *= 3.0F;
  stack.back()->SetMassData(&heavy);
  scene.run(240);
  ASSERT_TRUE(scene.sleeper->asleep(*stack.back()));
  scene.sleeper->wake(*stack.back());
  EXPECT_EQ(stack.back()->GetMass(), 1800.0F);
}

/// The program's own listener hears of every contact that Box2D begins.
TEST(Box2dSleeper, PassesContactsOnToTheListenerOfTheProgram) {
  struct Counter : b2ContactListener {
    int begun = 0;
    void BeginContact(b2Contact*) override { ++begun; }
  };
  Counter first;
  Counter second;
  SleepingBox2dScene scene;
  scene.world.SetContactListener(&first);
  scene.drop(drops<2>(1, 1).front());
  scene.run(200);
  EXPECT_GT(first.begun, 0);
  scene.world.SetContactListener(&second);
  scene.drop(drops<2>(1, 2).front());
  scene.run(200);
  EXPECT_GT(second.begun, 0);
  scene.sleeper.reset();
  EXPECT_EQ(scene.world.GetContactManager().m_contactListener, &second);
}

/// The impulses of a sleeping box name the fixtures that it touched.
TEST(Box2dSleeper, LetsABoxFallWhenTheFixtureBelowItIsDestroyed) {
  SleepingBox2dScene scene;
  b2Body& shelf = scene.add_box({4, 1}, {0, 3}, b2_staticBody);
  b2Body& box = scene.drop({{0, 3.8}, Rotation<2>::Identity()});
  scene.run(240);
  ASSERT_TRUE(scene.sleeper->asleep(box));
  scene.sleeper->wake_near(shelf);
  shelf.DestroyFixture(shelf.GetFixtureList());
  scene.run(240);
  EXPECT_NEAR(scene.place(box).y(), 0.3, 0.02);
  EXPECT_TRUE(scene.sleeper->asleep(box));
}

/// The listener of a program lets two boxes pass through each other, as those of platforms that are solid from above.
TEST(Box2dSleeper, LeavesOutContactsThatTheProgramDisables) {
  struct Ghosts : b2ContactListener {
    const b2Body* ground = nullptr;
    void PreSolve(b2Contact* contact, const b2Manifold*) override {
      if (contact->GetFixtureA()->GetBody() != ground && contact->GetFixtureB()->GetBody() != ground)
        contact->SetEnabled(false);
    }
  };
  Ghosts ghosts;
  SleepingBox2dScene scene;
  ghosts.ground = scene.ground;
  scene.world.SetContactListener(&ghosts);
  b2Body& box = scene.drop({{0, 0.3}, Rotation<2>::Identity()});
  b2Body& other = scene.drop({{3, 0.3}, Rotation<2>::Identity()});
  scene.run(240);
  ASSERT_TRUE(scene.sleeper->asleep(box));
  scene.push(other, {-8.0, 0.0});
  for (int i = 0; i < 120; ++i) {
    scene.step();
    EXPECT_TRUE(scene.sleeper->asleep(box)) << scene.place(other).x();
  }
  EXPECT_LT(scene.place(other).x(), -2.0);
}

TEST(Box2dSleeper, RefusesWhatItCannotWatch) {
  SleepingBox2dScene scene;
  EXPECT_THROW(scene.sleeper->add(*scene.ground), InvalidValue);
  b2Body& box = scene.drop(drops<2>(1, 1).front());
  EXPECT_THROW(scene.sleeper->add(box), InvalidValue);
  EXPECT_THROW(scene.sleeper->wake(*scene.ground), InvalidValue);
  b2BodyDef def;
  def.type = b2_dynamicBody;
  EXPECT_THROW(scene.sleeper->add(*scene.world.CreateBody(&def)), InvalidValue);  // without fixtures
}

TEST(Box2dSleeper, LeavesOutBodiesWithoutASolidFixture) {
  SleepingBox2dScene scene;
  b2BodyDef def;
  def.type = b2_dynamicBody;
  b2CircleShape shape;
  shape.m_radius = 0.5F;
  b2FixtureDef sensor;
  sensor.shape = &shape;
  sensor.isSensor = true;
  b2Body& ghost = *scene.world.CreateBody(&def);
  ghost.CreateFixture(&sensor);
  scene.add_box({1, 1}, {0, 5}, b2_dynamicBody);
  EXPECT_EQ(scene.sleeper->add_all(), 0);
  EXPECT_EQ(scene.sleeper->size(), 1);
  EXPECT_THROW(scene.sleeper->add(ghost), InvalidValue);
}

/// A sleeper that takes the place of another one is none that is there with it.
TEST(Box2dSleeper, IsTheOnlyOneOfItsWorld) {
  SleepingBox2dScene scene;
  scene.step();
  auto second = std::make_unique<Box2dSleeper>(scene.world);
  EXPECT_THROW(second->before_step(), InvalidValue);
  scene.step();
  scene.sleeper.reset();
  second->before_step();
}

TEST(Box2dSleeper, ChangesNoBitWhenItIsOff) {
  SleepingBox2dScene with({.enabled = false});
  Box2dScene without;
  const std::vector<Pose<2>> starts = drops<2>(60, 1);
  for (int step = 0; step < 900; ++step) {
    if (step % steps_between_drops == 0 && step / steps_between_drops < std::ssize(starts)) {
      with.drop(starts[step / steps_between_drops]);
      without.add_drop(starts[step / steps_between_drops]);
    }
    with.step();
    without.step();
  }
  const std::vector<b2Body*> a = with.dynamic_bodies();
  const std::vector<b2Body*> b = without.dynamic_bodies();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i]->GetPosition(), b[i]->GetPosition());
    EXPECT_EQ(a[i]->GetAngle(), b[i]->GetAngle());
    EXPECT_EQ(a[i]->GetLinearVelocity(), b[i]->GetLinearVelocity());
  }
}

}  // namespace
}  // namespace talus::test

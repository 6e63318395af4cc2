#include <gtest/gtest.h>

#include <algorithm>

#include "tests/sleeper/bullet_scene.h"

namespace talus::test {
namespace {

btVector3 place(const btRigidBody& body) { return body.getWorldTransform().getOrigin(); }

/// Four boxes on each other, asleep.
class SleepingStack : public ::testing::Test {
 protected:
  SleepingStack() {
    for (int i = 0; i < 4; ++i) stack.push_back(&scene.add_box({1, 1, 1}, {0, 0, 0.5 + i}, 1000));
    scene.sleeper->add_all();
    scene.run(180);
    // The stability check of the settled stack is over: nothing wakes any more by itself.
    scene.run(300);
  }
  int asleep() const {
    return static_cast<int>(std::ranges::count_if(stack, [&](btRigidBody* b) { return scene.sleeper->asleep(*b); }));
  }

  SleepingBulletScene scene;
  std::vector<btRigidBody*> stack;
};

TEST_F(SleepingStack, IsStaticToBulletUntilItWakes) {
  ASSERT_EQ(asleep(), 4);
  for (const btRigidBody* body : stack) {
    EXPECT_EQ(body->getMass(), 0);
    EXPECT_FALSE(body->isActive());
    EXPECT_FLOAT_EQ(static_cast<float>(scene.sleeper->mass(*body)), 1000.0F);
  }
  scene.sleeper->wake_all();
  for (const btRigidBody* body : stack) {
    EXPECT_FLOAT_EQ(static_cast<float>(body->getMass()), 1000.0F);
    EXPECT_FALSE(body->isStaticObject());
    EXPECT_TRUE(body->isActive());
    EXPECT_FLOAT_EQ(static_cast<float>(body->getInvInertiaDiagLocal().x()), 6.0F / 1000.0F);
  }
}

/// Manifolds keep their impulses, so a woken stack stands. It moves by a tenth of a millimetre, as one that Bullet has
/// just stopped.
TEST_F(SleepingStack, StandsStillWhenItWakes) {
  const btScalar top = place(*stack.back()).z();
  scene.sleeper->wake_all();
  for (int i = 0; i < 30; ++i) {
    scene.step();
    EXPECT_NEAR(place(*stack.back()).z(), top, 2e-4);
  }
}

TEST_F(SleepingStack, FallsWhenItsLowestBoxIsRemoved) {
  scene.sleeper->about_to_remove(*stack.front());
  scene.remove(*stack.front());
  stack.erase(stack.begin());
  scene.run(300);
  EXPECT_NEAR(place(*stack.front()).z(), 0.5, 0.02);
  EXPECT_NEAR(place(*stack.back()).z(), 2.5, 0.04);
}

TEST_F(SleepingStack, FallsWhenTheGroundIsRemoved) {
  scene.sleeper->about_to_remove(*scene.ground);
  scene.remove(*scene.ground);
  scene.run(120);
  for (const btRigidBody* body : stack) EXPECT_LT(place(*body).z(), 0.0);
}

TEST_F(SleepingStack, FallsWhenItsLowestBoxIsTakenElsewhere) {
  stack.front()->setWorldTransform(btTransform(btQuaternion::getIdentity(), {20, 0, btScalar(0.5)}));
  scene.sleeper->moved(*stack.front());
  EXPECT_FALSE(scene.sleeper->asleep(*stack.front()));
  scene.run(300);
  EXPECT_NEAR(place(*stack[1]).z(), 0.5, 0.02);
  EXPECT_NEAR(place(*stack[3]).z(), 2.5, 0.04);
}

TEST_F(SleepingStack, WakesAndSlidesWhenGravityTurns) {
  scene.world.setGravity({btScalar(9.81), 0, btScalar(-1.0)});
  scene.step();
  EXPECT_EQ(asleep(), 0);
  scene.run(60);
  for (const btRigidBody* body : stack) EXPECT_GT(place(*body).x(), 0.5);
}

TEST_F(SleepingStack, WakesBeforeItIsPushed) {
  scene.sleeper->wake(*stack.back());
  stack.back()->setLinearVelocity({3, 0, 0});
  scene.run(120);
  EXPECT_GT(place(*stack.back()).x(), 1.0);
  EXPECT_LT(place(*stack.back()).z(), 1.0);
}

#ifndef NDEBUG
TEST_F(SleepingStack, IsFoundInADebugBuildWhenItWasMovedBehindItsBack) {
  stack.back()->setWorldTransform(btTransform(btQuaternion::getIdentity(), {5, 0, 9}));
  EXPECT_THROW(scene.step(), InvalidValue);
}
#endif

TEST_F(SleepingStack, StaysAwakeWithAConstraint) {
  btPoint2PointConstraint hold(*stack.back(), btVector3(0, 0, 0));
  scene.sleeper->wake(*stack.back());
  scene.world.addConstraint(&hold);
  scene.run(240);
  EXPECT_FALSE(scene.sleeper->asleep(*stack.back()));
  scene.world.removeConstraint(&hold);
  stack.back()->activate();  // Bullet leaves it asleep although nothing holds it any more
  scene.run(240);
  EXPECT_TRUE(scene.sleeper->asleep(*stack.back()));
}

TEST_F(SleepingStack, IsRefusedOnceItIsRemoved) {
  const Handle handle = scene.sleeper->handle(*stack.back());
  scene.sleeper->about_to_remove(*stack.back());
  scene.remove(*stack.back());
  EXPECT_THROW(scene.sleeper->body(handle), InvalidValue);
  btRigidBody& other = scene.add_box({1, 1, 1}, {0, 0, 5}, 1000);
  const Handle next = scene.sleeper->add(other);
  EXPECT_EQ(next.slot, handle.slot);
  EXPECT_THROW(scene.sleeper->body(handle), InvalidValue);
  EXPECT_EQ(&scene.sleeper->body(next), &other);
}

TEST_F(SleepingStack, SleepsAgainAfterSaveAndLoad) {
  ASSERT_EQ(asleep(), 4);
  const std::vector<SavedSleep> saved = scene.sleeper->snapshot();
  std::vector<btTransform> places;
  for (const btRigidBody* body : stack) places.push_back(body->getWorldTransform());
  scene.sleeper->wake(*stack.back());
  stack.back()->setLinearVelocity({3, 0, 0});
  scene.run(60);
  for (std::size_t i = 0; i < stack.size(); ++i) stack[i]->setWorldTransform(places[i]);
  scene.sleeper->restore(saved);
  EXPECT_EQ(asleep(), 4);
  scene.run(120);
  for (std::size_t i = 0; i < stack.size(); ++i)
    EXPECT_NEAR((place(*stack[i]) - places[i].getOrigin()).length(), 0, 1e-3);
}

TEST(BulletSleeper, RefusesWhatItCannotWatch) {
  SleepingBulletScene scene;
  EXPECT_THROW(scene.sleeper->add(*scene.ground), InvalidValue);
  btRigidBody& box = scene.add_box({1, 1, 1}, {0, 0, 1}, 10);
  scene.sleeper->add(box);
  EXPECT_THROW(scene.sleeper->add(box), InvalidValue);
  EXPECT_THROW(scene.sleeper->wake(*scene.ground), InvalidValue);
  EXPECT_THROW(BulletSleeper(scene.world, {.extent = 0.0}), InvalidValue);
  EXPECT_THROW(BulletSleeper(scene.world, {.adaptive = {.rings = 1}}), InvalidValue);
}

/// A lift with a box on it rests, rises, rests and sinks; the box follows within its skin.
TEST(BulletSleeper, CarriesASleeperOnAPlatform) {
  SleepingBulletScene scene;
  btRigidBody& lift = scene.add_box({4, 4, 0.5}, {0, 0, 1}, 0);
  lift.setCollisionFlags(lift.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  lift.setActivationState(DISABLE_DEACTIVATION);
  btDefaultMotionState motion(lift.getWorldTransform());
  lift.setMotionState(&motion);
  btRigidBody& box = scene.add_box({1, 1, 1}, {0, 0, 1.75}, 1000);
  scene.sleeper->add_all();
  scene.run(240);
  ASSERT_TRUE(scene.sleeper->asleep(box));
  for (const double speed : {0.5, 0.0, -0.5}) {
    for (int i = 0; i < 120; ++i) {
      btTransform at;
      motion.getWorldTransform(at);
      at.getOrigin() += btVector3(0, 0, static_cast<btScalar>(speed * drop_dt));
      motion.setWorldTransform(at);
      scene.step();
      EXPECT_NEAR(place(box).z() - place(lift).z(), 0.75, 0.03);
    }
  }
}

/// The upper box sleeps a little above the lower one, as rounding leaves it, so that the lower one carries nothing when
/// it wakes.
TEST(BulletSleeper, LowersAStackOfSleepersOnAPlatform) {
  SleepingBulletScene scene;
  btRigidBody& lift = scene.add_lift({4, 4, 1}, {0, 0, 1.5});
  btRigidBody& lower = scene.drop({{0, 0, 2.3}, Rotation<3>::Identity()});
  btRigidBody& upper = scene.drop({{0, 0, 2.85}, Rotation<3>::Identity()});
  scene.run(240);
  ASSERT_TRUE(scene.sleeper->asleep(lower) && scene.sleeper->asleep(upper));
  const std::vector<SavedSleep> saved = scene.sleeper->snapshot();
  upper.getWorldTransform().getOrigin() += btVector3(0, 0, btScalar(0.004));
  scene.sleeper->restore(saved);
  ASSERT_TRUE(scene.sleeper->asleep(upper));
  for (int step = 1; step <= 60; ++step) {
    scene.move_lift(lift, {0, 0, 1.5 - 0.3 * drop_dt * step}, drop_dt);
    scene.step();
  }
  EXPECT_LT(place(lower).z(), 2.0);
  EXPECT_NEAR(place(upper).z() - place(lower).z(), 0.5, 0.02);
}

/// The engine's bits: nothing that a switched-off sleeper does reaches the world.
TEST(BulletSleeper, ChangesNoBitWhenItIsOff) {
  SleepingBulletScene with({.enabled = false});
  BulletScene without;
  const std::vector<Pose<3>> starts = drops<3>(60, 1);
  for (int step = 0; step < 900; ++step) {
    if (step % steps_between_drops == 0 && step / steps_between_drops < std::ssize(starts)) {
      with.drop(starts[step / steps_between_drops]);
      without.add_drop(starts[step / steps_between_drops]);
    }
    with.step();
    without.step();
  }
  for (std::size_t i = 0; i < with.bodies.size(); ++i) {
    EXPECT_TRUE(with.bodies[i]->getWorldTransform() == without.bodies[i]->getWorldTransform());
    EXPECT_TRUE(with.bodies[i]->getLinearVelocity() == without.bodies[i]->getLinearVelocity());
  }
}

/// Heaps with y up, as most games have them, are those with z up, turned: the same bodies sleep at the end.
TEST(BulletSleeper, TakesAnyAxisAsUp) {
  SleepingBulletScene scene;
  scene.remove(*scene.ground);
  scene.sleeper.emplace(scene.world, SleeperOptions{.up = UpAxis::y});
  scene.world.setGravity({0, btScalar(-9.81), 0});
  scene.add_box({200, 2, 200}, {0, -1, 0}, 0);
  for (int i = 0; i < 30; ++i) scene.add_box({1, 0.5, 0.7}, {0.1 * (i % 3), 1.0 + 1.2 * i, 0.1 * (i % 2)}, 350);
  scene.sleeper->add_all();
  scene.run(1200);
  EXPECT_LE(scene.sleeper->awake(), 3);
  for (const auto& body : scene.bodies) EXPECT_LT(place(*body).y(), 5);
}

}  // namespace
}  // namespace talus::test

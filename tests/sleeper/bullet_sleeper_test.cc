#include <gtest/gtest.h>

#include "tests/sleeper/bullet_scene.h"
#include "tests/sleeper/stack.h"

namespace talus::test {
namespace {

btVector3 place(const btRigidBody& body) { return body.getWorldTransform().getOrigin(); }

using SleepingBulletStack = SleepingStack<SleepingBulletScene>;
INSTANTIATE_TYPED_TEST_SUITE_P(Bullet, SleepingStack, SleepingBulletScene);

TEST_F(SleepingBulletStack, IsStaticToBulletUntilItWakes) {
  constexpr float mass = 350.0F;  // of 1 x 0.7 x 0.5 m
  ASSERT_EQ(asleep(), 4);
  for (const btRigidBody* body : stack) {
    EXPECT_EQ(body->getMass(), 0);
    EXPECT_FALSE(body->isActive());
    EXPECT_FLOAT_EQ(static_cast<float>(scene.sleeper->mass(*body)), mass);
  }
  scene.sleeper->wake_all();
  for (const btRigidBody* body : stack) {
    EXPECT_FLOAT_EQ(static_cast<float>(body->getMass()), mass);
    EXPECT_FALSE(body->isStaticObject());
    EXPECT_TRUE(body->isActive());
    EXPECT_FLOAT_EQ(static_cast<float>(body->getInvInertiaDiagLocal().x()), 12.0F / (mass * (0.49F + 0.25F)));
  }
}

/// Bullet keeps the impulses of contacts while cubes sleep, so they stand when they wake. The top cube moves by 0.1 mm,
/// as when Bullet itself has just stopped it.
TEST(BulletSleeper, WakesCubesThatStandStill) {
  SleepingBulletScene scene;
  for (int i = 0; i < 4; ++i) scene.add_box({1, 1, 1}, {0, 0, 0.5 + i}, 1000);
  scene.sleeper->add_all();
  scene.run(480);
  const btRigidBody& upper = *scene.bodies.back();
  ASSERT_TRUE(scene.sleeper->asleep(upper));
  const btScalar height = place(upper).z();
  scene.sleeper->wake_all();
  for (int i = 0; i < 30; ++i) {
    scene.step();
    EXPECT_NEAR(place(upper).z(), height, 2e-4);
  }
}

#ifndef NDEBUG
TEST_F(SleepingBulletStack, IsFoundInADebugBuildWhenItWasMovedBehindItsBack) {
  stack.back()->setWorldTransform(btTransform(btQuaternion::getIdentity(), {5, 0, 9}));
  EXPECT_THROW(scene.step(), InvalidValue);
}
#endif

/// Bullet lists a constraint with its bodies only if it switches off their collision.
TEST_F(SleepingBulletStack, WakesAndStaysAwakeWithAConstraintUntilThatBreaks) {
  for (const bool collide : {true, false}) {
    ASSERT_EQ(asleep(), 4);
    btPoint2PointConstraint joint(*stack[2], *stack[3], btVector3(0, 0, 0.25F), btVector3(0, 0, -0.25F));
    scene.world.addConstraint(&joint, !collide);
    EXPECT_EQ(asleep(), 4);
    scene.run(240);
    EXPECT_FALSE(scene.sleeper->asleep(*stack[2])) << collide;
    EXPECT_FALSE(scene.sleeper->asleep(*stack[3])) << collide;
    EXPECT_TRUE(scene.sleeper->asleep(*stack[0])) << collide;
    joint.setEnabled(false);
    stack[2]->activate();  // Bullet leaves them asleep although nothing holds them any more
    stack[3]->activate();
    scene.run(240);
    EXPECT_EQ(asleep(), 4) << collide;
    scene.world.removeConstraint(&joint);
  }
}

TEST(BulletSleeper, CountsThoseWithConstraintsAmongAllThatItAdds) {
  SleepingBulletScene scene;
  for (int i = 0; i < 4; ++i) scene.add_box({1, 1, 1}, {2.0 * i, 0, 0.5}, 1000);
  btPoint2PointConstraint joint(*scene.bodies[1], *scene.bodies[2], btVector3(1, 0, 0), btVector3(-1, 0, 0));
  scene.world.addConstraint(&joint);
  EXPECT_EQ(scene.sleeper->add_all(), 2);
  scene.world.removeConstraint(&joint);
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

/// A constraint still names the body, as when a program takes the two out in this order.
TEST(BulletSleeper, RefusesAStepWithABodyThatLeftTheWorldUnannounced) {
  SleepingBulletScene scene;
  btRigidBody& box = scene.add_box({1, 1, 1}, {0, 0, 5}, 1000);
  btRigidBody& other = scene.add_box({1, 1, 1}, {5, 0, 5}, 1000);
  scene.sleeper->add_all();
  btPoint2PointConstraint joint(box, other, btVector3(2.5, 0, 0), btVector3(-2.5, 0, 0));
  scene.world.addConstraint(&joint);
  scene.step();
  scene.world.removeRigidBody(&box);
  EXPECT_THROW(scene.sleeper->before_step(), InvalidValue);
  scene.world.removeConstraint(&joint);
  scene.sleeper->about_to_remove(box);
  scene.step();
  EXPECT_EQ(scene.sleeper->size(), 1);
}

TEST(BulletSleeper, LeavesOutBodiesWithoutASolidShape) {
  SleepingBulletScene scene;
  btCompoundShape nothing;
  btEmptyShape empty;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  for (btCollisionShape* shape : {static_cast<btCollisionShape*>(&nothing), static_cast<btCollisionShape*>(&empty)}) {
    bodies.push_back(std::make_unique<btRigidBody>(btScalar(1), nullptr, shape, btVector3(1, 1, 1)));
    scene.world.addRigidBody(bodies.back().get());
  }
  scene.add_box({1, 1, 1}, {0, 0, 1}, 10);
  EXPECT_EQ(scene.sleeper->add_all(), 0);
  EXPECT_EQ(scene.sleeper->size(), 1);
  for (const auto& body : bodies) {
    EXPECT_THROW(scene.sleeper->add(*body), InvalidValue);
    scene.world.removeRigidBody(body.get());
  }
}

/// A child beside the origin alone.
TEST(BulletSleeper, PutsABodyToSleepWhoseCentreOfMassLiesOutsideOfItsShape) {
  SleepingBulletScene scene;
  btBoxShape foot({2, 2, btScalar(0.5)});
  btCompoundShape shape;
  shape.addChildShape(btTransform(btQuaternion::getIdentity(), {0, 0, -2}), &foot);
  btRigidBody body(btScalar(1000), nullptr, &shape, btVector3(1000, 1000, 1000));
  body.setWorldTransform(btTransform(btQuaternion::getIdentity(), {0, 0, btScalar(2.5)}));
  scene.world.addRigidBody(&body);
  scene.sleeper->add_all();
  scene.run(480);
  EXPECT_TRUE(scene.sleeper->asleep(body));
  scene.sleeper->about_to_remove(body);
  scene.world.removeRigidBody(&body);
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

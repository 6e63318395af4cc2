#pragma once
// A program of one's own with Bullet: a ground, and what falls on it.

#include <memory>
#include <optional>
#include <vector>

#include "talus/bullet.h"
#include "tests/sleeper/drops.h"

namespace talus::test {

inline btVector3 to_bullet(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

/// z is up.
class BulletScene {
 public:
  BulletScene() {
    world.setGravity({0, 0, btScalar(-9.81)});
    world.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    ground = &add_box({200, 200, 2}, {0, 0, -1}, 0);
  }
  ~BulletScene() {
    for (const auto& body : bodies) world.removeRigidBody(body.get());
  }

  btRigidBody& add_box(const Vec3& size, const Vec3& at, double mass,
                       const btQuaternion& turn = btQuaternion::getIdentity()) {
    shapes.push_back(std::make_unique<btBoxShape>(to_bullet(0.5 * size)));
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shapes.back()->calculateLocalInertia(static_cast<btScalar>(mass), inertia);
    btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(mass), nullptr, shapes.back().get(), inertia);
    info.m_startWorldTransform = btTransform(turn, to_bullet(at));
    info.m_friction = btScalar(std::sqrt(0.5));  // Bullet multiplies: 0.5 between two bodies, talus's default
    bodies.push_back(std::make_unique<btRigidBody>(info));
    world.addRigidBody(bodies.back().get());
    return *bodies.back();
  }
  btRigidBody& add_drop(const Pose<3>& pose) {
    const Rotation<3>& q = pose.rotation;
    const btQuaternion turn(static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()), static_cast<btScalar>(q.z()),
                            static_cast<btScalar>(q.w()));
    const Vec3 size = box_size<3>();
    return add_box(size, pose.position, 1000.0 * size.prod(), turn);
  }
  void remove(btRigidBody& body) {
    world.removeRigidBody(&body);
    std::erase_if(bodies, [&](const auto& one) { return one.get() == &body; });
  }
  void step(double dt = drop_dt) { world.stepSimulation(static_cast<btScalar>(dt), 0); }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  btRigidBody* ground = nullptr;
};

/// With a sleeper: what the three lines in a loop of a program are.
class SleepingBulletScene : public BulletScene {
 public:
  using Body = btRigidBody;
  static constexpr int dimension = 3;

  Vec3 place(const Body& body) const {
    const btVector3& at = body.getWorldTransform().getOrigin();
    return {at.x(), at.y(), at.z()};
  }
  Pose<3> pose(const Body& body) const {
    const btQuaternion turn = body.getWorldTransform().getRotation();
    return {place(body), Rotation<3>(turn.w(), turn.x(), turn.y(), turn.z())};
  }
  void take_away(Body& body) {
    sleeper->about_to_remove(body);
    remove(body);
  }
  void take_away_ground() { take_away(*ground); }
  void put(Body& body, const Vec3& at) {
    body.setWorldTransform(btTransform(body.getWorldTransform().getBasis(), to_bullet(at)));
    sleeper->moved(body);
  }
  void push(Body& body, const Vec3& velocity) {
    sleeper->wake(body);
    body.setLinearVelocity(to_bullet(velocity));
  }
  /// Holds a body where it is, until released.
  auto hold(Body& body) {
    auto joint = std::make_unique<btPoint2PointConstraint>(body, btVector3(0, 0, 0));
    world.addConstraint(joint.get());
    return joint;
  }
  void release(const std::unique_ptr<btPoint2PointConstraint>& joint) {
    world.removeConstraint(joint.get());
    joint->getRigidBodyA().activate();  // Bullet leaves it asleep although nothing holds it any more
  }
  void set_gravity(const Vec3& gravity) { world.setGravity(to_bullet(gravity)); }
  /// A kinematic block.
  Body& add_lift(const Vec3& size, const Vec3& at) {
    Body& lift = add_box(size, at, 0);
    lift.setCollisionFlags(lift.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    lift.setActivationState(DISABLE_DEACTIVATION);
    lift_motion.setWorldTransform(lift.getWorldTransform());
    lift.setMotionState(&lift_motion);
    sleeper->add(lift);
    return lift;
  }
  /// Where it is after the next step.
  void move_lift(Body&, const Vec3& to, double) {
    lift_motion.setWorldTransform(btTransform(btQuaternion::getIdentity(), to_bullet(to)));
  }
  /// Puts it elsewhere at once, not by a motion that throws what lies on it.
  void place_lift(Body& lift, const Vec3& to) {
    const btTransform at(btQuaternion::getIdentity(), to_bullet(to));
    lift_motion.setWorldTransform(at);
    lift.setInterpolationWorldTransform(at);
    lift.setWorldTransform(at);
    sleeper->moved(lift);
  }
  /// Place and turn of a body, to be loaded again.
  using Saved = btTransform;
  Saved save(const Body& body) const { return body.getWorldTransform(); }
  void load(Body& body, const Saved& saved) { body.setWorldTransform(saved); }

  explicit SleepingBulletScene(const SleeperOptions& options = {}) : sleeper(std::in_place, world, options) {}

  btRigidBody& drop(const Pose<3>& pose) {
    btRigidBody& body = add_drop(pose);
    sleeper->add(body);
    return body;
  }
  void keep_awake(Body& body) { body.setActivationState(DISABLE_DEACTIVATION); }
  SleepChanges<3> step(double dt = drop_dt) {
    sleeper->before_step();
    BulletScene::step(dt);
    return sleeper->after_step(dt);
  }
  /// A step of the engine alone.
  void step_engine() { BulletScene::step(); }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }

  btDefaultMotionState lift_motion;
  std::optional<BulletSleeper> sleeper;
};

}  // namespace talus::test

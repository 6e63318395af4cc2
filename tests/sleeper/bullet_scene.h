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
  explicit SleepingBulletScene(const SleeperOptions& options = {}) : sleeper(std::in_place, world, options) {}

  btRigidBody& drop(const Pose<3>& pose) {
    btRigidBody& body = add_drop(pose);
    sleeper->add(body);
    return body;
  }
  SleepChanges<3> step(double dt = drop_dt) {
    sleeper->before_step();
    BulletScene::step(dt);
    return sleeper->after_step(dt);
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }

  std::optional<BulletSleeper> sleeper;
};

}  // namespace talus::test

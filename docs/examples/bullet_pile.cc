// A pile in a Bullet world of one's own: 100 boxes fall on one spot, and those at rest cost nothing.
#include <talus/bullet.h>

#include <cstdio>
#include <memory>
#include <vector>

int main() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);  // gravity along -y
  btBoxShape floor_shape(btVector3(50, 1, 50));
  btRigidBody floor(0, nullptr, &floor_shape);
  floor.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, -1, 0)));
  world.addRigidBody(&floor);

  btBoxShape shape(btVector3(btScalar(0.5), btScalar(0.35), btScalar(0.25)));
  btVector3 inertia;
  shape.calculateLocalInertia(350, inertia);
  std::vector<std::unique_ptr<btRigidBody>> boxes;

  talus::BulletSleeper sleeper(world);
  for (int step = 0; step < 1800; ++step) {
    if (step % 15 == 0 && boxes.size() < 100) {
      boxes.push_back(std::make_unique<btRigidBody>(350, nullptr, &shape, inertia));
      const btVector3 start(btScalar(0.1) * btScalar(step % 7), 8, btScalar(0.1) * btScalar(step % 5));
      boxes.back()->setWorldTransform(btTransform(btQuaternion(btScalar(step), btScalar(0.7), btScalar(0.3)), start));
      world.addRigidBody(boxes.back().get());
      sleeper.add(*boxes.back());
    }
    sleeper.before_step();
    world.stepSimulation(btScalar(1.0 / 60.0), 0);
    sleeper.after_step(1.0 / 60.0);
  }
  std::printf("%d boxes, %d awake\n", sleeper.size(), sleeper.awake());

  // Sleeping bodies feel no force. Woken first, the box on top flies away, and what it rested on stays asleep.
  sleeper.wake(*boxes.back());
  boxes.back()->setLinearVelocity(btVector3(0, 5, 0));
  for (auto box = boxes.begin(); box != boxes.end(); ++box) {  // a program removes its bodies as ever, and says so
    sleeper.about_to_remove(**box);
    world.removeRigidBody(box->get());
  }
  std::printf("%d boxes\n", sleeper.size());
  world.removeRigidBody(&floor);
}

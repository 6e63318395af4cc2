// Three thousand shapes in a Bullet world of one's own, as gz-sim's world 3k_shapes.sdf has them: boxes, cylinders and
// spheres in three rows on the ground. Prints how many are awake, and the processor time of a step, while they settle
// and once they sleep.
#include <talus/bullet.h>

#include <array>
#include <cstdio>
#include <ctime>
#include <memory>
#include <vector>

int main() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, btScalar(-9.8)));
  btStaticPlaneShape ground_shape(btVector3(0, 0, 1), 0);
  btRigidBody ground(0, nullptr, &ground_shape);
  world.addRigidBody(&ground);

  constexpr btScalar half = 0.5;  // [m]
  btBoxShape box(btVector3(half, half, half));
  btCylinderShapeZ cylinder(btVector3(half, half, half));
  btSphereShape sphere(half);
  const std::array<btCollisionShape*, 3> shapes = {&box, &cylinder, &sphere};
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  for (int i = 0; i < 3000; ++i) {
    const int kind = i % 3;
    const auto mass = static_cast<btScalar>(kind + 1);  // [kg]
    bodies.push_back(std::make_unique<btRigidBody>(mass, nullptr, shapes[kind], btVector3(mass, mass, mass)));
    const btVector3 place(btScalar(1.5) * btScalar(i / 3), btScalar(1.5) * btScalar(kind - 1), half);
    bodies.back()->setWorldTransform(btTransform(btQuaternion::getIdentity(), place));
    world.addRigidBody(bodies.back().get());
  }

  talus::BulletSleeper sleeper(world);
  sleeper.add_all();
  constexpr double dt = 0.001;  // [s], as there
  for (int part = 0; part < 4; ++part) {
    const std::clock_t start = std::clock();
    for (int step = 0; step < 100; ++step) {
      sleeper.before_step();
      world.stepSimulation(btScalar(dt), 0);
      sleeper.after_step(dt);
    }
    std::printf("%.1f s: %d of %d awake, %.2f ms a step\n", 0.1 * (part + 1), sleeper.awake(), sleeper.size(),
                10.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  for (const auto& body : bodies) {
    sleeper.about_to_remove(*body);
    world.removeRigidBody(body.get());
  }
  world.removeRigidBody(&ground);
}

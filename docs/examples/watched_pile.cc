// A pile in a Bullet world of the program's own, with a record, the live view and a watch for faults: a line each.
// watched_pile [RECORD]; meanwhile `talus monitor` or `talus view --live` shows it, afterwards `talus view RECORD`.
#include <talus/bullet.h>
#include <talus/simulation.h>
#include <talus/telemetry.h>

#include <cstdio>
#include <memory>
#include <vector>

int main(int count, char** arguments) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broad_phase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broad_phase, &solver, &configuration);
  btStaticPlaneShape floor_shape(btVector3(0, 1, 0), 0);
  btCylinderShape drum_shape(btVector3(0.5F, 0.3F, 0.5F));
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  const auto add = [&](btScalar mass, btCollisionShape& shape, const btVector3& at) -> btRigidBody& {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    btRigidBody& body = *bodies.emplace_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
    body.setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
    world.addRigidBody(&body);
    return body;
  };
  add(0, floor_shape, {0, 0, 0});

  talus::BulletSleeper sleeper(world);
  sleeper.observe(talus::record_world<3>(count > 1 ? arguments[1] : "pile.lcm", {.name = "drums", .engine = "bullet"}));
  sleeper.observe(talus::publish_world<3>({.name = "drums", .engine = "bullet"}));
  sleeper.observe(std::make_unique<talus::SleeperWatch<3>>(
      [](const talus::Warning& warning) { std::printf("%s\n", talus::advice(warning).c_str()); }));
  for (int step = 0; step < 1200; ++step) {
    if (step % 12 == 0 && step < 600)
      sleeper.add(add(1, drum_shape, {0.3F * static_cast<float>(step % 7), 6, 0.3F * static_cast<float>(step % 5)}));
    sleeper.before_step();
    world.stepSimulation(1.0F / 60.0F, 0);
    sleeper.after_step(1.0 / 60.0);
  }
  sleeper.end_observers();
  std::printf("%d bodies, %d awake\n", sleeper.size(), sleeper.awake());
  for (const auto& body : bodies) world.removeRigidBody(body.get());
}

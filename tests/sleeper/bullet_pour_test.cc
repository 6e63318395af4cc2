#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "common/shape/catalogue.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "sim3d/make_world.h"
#include "tests/sleeper/bullet_scene.h"

namespace talus::test {
namespace {

constexpr int boxes = 300;
constexpr int settling_steps = 300;

int steps_of(int count) { return count * steps_between_drops + settling_steps; }

Poured pour_with_sleeper(unsigned seed) {
  SleepingBulletScene scene;
  const std::vector<Pose<3>> starts = drops<3>(boxes, seed);
  Poured poured;
  for (int step = 0; step < steps_of(boxes); ++step) {
    if (step % steps_between_drops == 0 && step / steps_between_drops < boxes)
      scene.drop(starts[step / steps_between_drops]);
    scene.step();
    poured.mean_awake += static_cast<double>(scene.sleeper->awake()) / steps_of(boxes);
  }
  for (const auto& body : scene.bodies)
    if (body.get() != scene.ground) poured.centre_height += body->getWorldTransform().getOrigin().z() / boxes;
  return poured;
}

/// The same boxes in talus's own world on Bullet.
Poured pour_in_own_world(unsigned seed) {
  Scene<3> scene;
  scene.policy.kind = "adaptive";
  scene.policy.adaptive = SleeperOptions{}.adaptive;
  scene.world.shapes = {make_shape<3>("box", box_pieces<3>(box_size<3>()), {})};
  scene.piles = {{}};
  Simulation<3> simulation(scene, make_bullet_world(scene.world), make_policy(scene));
  const std::vector<Pose<3>> starts = drops<3>(boxes, seed);
  Poured poured;
  for (int step = 0; step < steps_of(boxes); ++step) {
    if (step % steps_between_drops == 0 && step / steps_between_drops < boxes)
      simulation.add({.pose = starts[step / steps_between_drops]});
    simulation.step();
    poured.mean_awake += static_cast<double>(simulation.world().awake().size()) / steps_of(boxes);
  }
  for (const Pose<3>& pose : simulation.world().states().pose) poured.centre_height += pose.position.z() / boxes;
  return poured;
}

/// The two worlds differ in solver settings and margins, so only the means over seeds compare: the height within 7 %,
/// of which the seeds' spread is 4 %, and the bodies awake within a third.
TEST(BulletSleeper, PilesBoxesAsTalusDoesInItsOwnWorld) {
  constexpr std::array<unsigned, 3> seeds = {1, 2, 3};
  Poured attached;
  Poured own;
  for (const unsigned seed : seeds) {
    const Poured a = pour_with_sleeper(seed);
    const Poured b = pour_in_own_world(seed);
    attached.centre_height += a.centre_height / seeds.size();
    attached.mean_awake += a.mean_awake / seeds.size();
    own.centre_height += b.centre_height / seeds.size();
    own.mean_awake += b.mean_awake / seeds.size();
  }
  EXPECT_NEAR(attached.centre_height, own.centre_height, 0.07 * own.centre_height);
  EXPECT_NEAR(attached.mean_awake, own.mean_awake, own.mean_awake / 3.0);
}

}  // namespace
}  // namespace talus::test

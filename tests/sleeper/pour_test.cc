// The same boxes poured in an engine of one's own and in talus's own world on that engine.
#include "tests/sleeper/pour.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "common/shape/catalogue.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "sim2d/make_world.h"
#include "sim3d/make_world.h"
#include "tests/sleeper/box2d_scene.h"
#include "tests/sleeper/bullet_scene.h"

namespace talus::test {
namespace {

std::unique_ptr<World<2>> make_world(const WorldDescription<2>& description) { return make_box2d_world(description); }
std::unique_ptr<World<3>> make_world(const WorldDescription<3>& description) { return make_bullet_world(description); }

/// With the engine's own solver, as in a program.
template <int Dim>
Pour pour_in_own_world(int boxes, unsigned seed) {
  Scene<Dim> scene;
  scene.policy.kind = "adaptive";
  scene.policy.adaptive = SleeperOptions{}.adaptive;
  scene.world.solver.kind = "engine";
  scene.world.shapes = {make_shape<Dim>("box", box_pieces<Dim>(box_size<Dim>()), {})};
  scene.piles = {{}};
  Simulation<Dim> simulation(scene, make_world(scene.world), make_policy(scene));
  const std::vector<Pose<Dim>> starts = drops<Dim>(boxes, seed);
  Pour result;
  const int steps = pour_steps(
      boxes, [&](int number) { simulation.add({.pose = starts[number]}); },
      [&] {
        simulation.step();
        result.awake += static_cast<double>(simulation.world().awake().size());
      });
  result.awake /= steps;
  for (const Pose<Dim>& pose : simulation.world().states().pose) result.height += pose.position[Dim - 1] / boxes;
  return result;
}

/// A number of each pour, in an engine of one's own and in talus's world.
struct Compared {
  std::vector<double> attached;
  std::vector<double> own;

  std::string row() const {
    const MeanWithError a = mean_with_error(attached);
    const MeanWithError o = mean_with_error(own);
    return fmt::format("{:.3f} ± {:.3f} | {:.3f} ± {:.3f}", a.mean, a.error, o.mean, o.error);
  }
  /// Of the means, in standard errors of the difference.
  double difference() const {
    const MeanWithError a = mean_with_error(attached);
    const MeanWithError o = mean_with_error(own);
    return (a.mean - o.mean) / std::hypot(a.error, o.error);
  }
};

template <typename Scene>
void expect_as_in_own_world(std::string_view engine, unsigned seeds) {
  constexpr int boxes = 300;
  Compared height;
  Compared awake;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const Pour attached = pour<Scene>(boxes, seed, Sleep::of_talus);
    const Pour own = pour_in_own_world<Scene::dimension>(boxes, seed);
    height.attached.push_back(attached.height);
    height.own.push_back(own.height);
    awake.attached.push_back(attached.awake);
    awake.own.push_back(own.awake);
  }
  fmt::print("| {} | {} | {} | {} |\n", engine, seeds, height.row(), awake.row());
  EXPECT_LT(std::abs(height.difference()), 3.0);
  EXPECT_LT(std::abs(awake.difference()), 3.0);
}

TEST(APour, OnBox2dPilesAsInTalussOwnWorld) { expect_as_in_own_world<SleepingBox2dScene>("Box2D", 6); }
TEST(APour, OnBulletPilesAsInTalussOwnWorld) { expect_as_in_own_world<SleepingBulletScene>("Bullet", 6); }
TEST(LongPour, OnBox2dPilesAsInTalussOwnWorld) { expect_as_in_own_world<SleepingBox2dScene>("Box2D", 16); }
TEST(LongPour, OnBulletPilesAsInTalussOwnWorld) { expect_as_in_own_world<SleepingBulletScene>("Bullet", 16); }

/// Number of boxes, and of the seeds that they are poured with.
class LongPourCost : public ::testing::TestWithParam<std::pair<int, unsigned>> {};

TEST_P(LongPourCost, OnBox2dIsLessThanThatOfTheEngine) {
  expect_faster_pour<SleepingBox2dScene>("Box2D 2.4", GetParam().first, GetParam().second);
}
TEST_P(LongPourCost, OnBulletIsLessThanThatOfTheEngine) {
  expect_faster_pour<SleepingBulletScene>("Bullet", GetParam().first, GetParam().second);
}

INSTANTIATE_TEST_SUITE_P(Boxes, LongPourCost,
                         ::testing::Values(std::pair(300, 8U), std::pair(1000, 3U), std::pair(3000, 1U)));

}  // namespace
}  // namespace talus::test

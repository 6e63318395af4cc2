#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "tests/sleeper/bullet_scene.h"

namespace talus::test {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Time of a pour [s], and of it that of the sleeper.
struct Cost {
  double total = 0.0;
  double sleeper = 0.0;
};

Cost cost_of_pour(int boxes, const SleeperOptions& options, bool own_sleeping) {
  SleepingBulletScene scene(options);
  const std::vector<Pose<3>> starts = drops<3>(boxes, 1);
  Cost cost;
  for (int step = 0; step < boxes * steps_between_drops + 300; ++step) {
    if (step % steps_between_drops == 0 && step / steps_between_drops < boxes) {
      btRigidBody& body = scene.drop(starts[step / steps_between_drops]);
      if (!own_sleeping) body.setActivationState(DISABLE_DEACTIVATION);
    }
    const auto start = Clock::now();
    scene.sleeper->before_step();
    const double before = seconds_since(start);
    scene.BulletScene::step();
    const double stepped = seconds_since(start);
    scene.sleeper->after_step(drop_dt);
    cost.total += seconds_since(start);
    cost.sleeper += seconds_since(start) - stepped + before;
  }
  return cost;
}

class LongBulletPourCost : public ::testing::TestWithParam<int> {};

/// Plain Bullet, Bullet with its own sleeping, and a sleeper: the times of one pour.
TEST_P(LongBulletPourCost, IsLessThanThatOfPlainBullet) {
  const Cost plain = cost_of_pour(GetParam(), {.enabled = false}, false);
  const Cost own = cost_of_pour(GetParam(), {.enabled = false}, true);
  const Cost slept = cost_of_pour(GetParam(), {}, false);
  fmt::print("{} boxes: plain {:.2f} s, own sleeping {:.2f} s, sleeper {:.2f} s of which {:.2f} s are its own\n",
             GetParam(), plain.total, own.total, slept.total, slept.sleeper);
  EXPECT_LT(1.5 * slept.total, plain.total);
}

INSTANTIATE_TEST_SUITE_P(Boxes, LongBulletPourCost, ::testing::Values(300, 1000));

}  // namespace
}  // namespace talus::test

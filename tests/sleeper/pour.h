#pragma once
// A pour of boxes in an engine of one's own: how high they pile and what it costs.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ctime>
#include <string_view>
#include <vector>

#include "common/measure/ensemble.h"
#include "tests/sleeper/drops.h"

namespace talus::test {

/// What puts boxes to sleep.
enum class Sleep { none, of_engine, of_talus };

/// How a pour went.
struct Pour {
  double height = 0.0;  // of the boxes' centre at the end [m]
  double awake = 0.0;   // mean over all steps, where talus puts boxes to sleep
  double time = 0.0;    // of the processor [s]
};

/// Drops a box every steps_between_drops, then simulates on for five seconds. `drop` adds the box of a number.
template <typename Drop, typename Step>
int pour_steps(int boxes, const Drop& drop, const Step& step) {
  const int steps = boxes * steps_between_drops + 300;
  for (int i = 0; i < steps; ++i) {
    if (i % steps_between_drops == 0 && i / steps_between_drops < boxes) drop(i / steps_between_drops);
    step();
  }
  return steps;
}

/// `Scene` is SleepingBulletScene or the like.
template <typename Scene>
Pour pour(int boxes, unsigned seed, Sleep sleep) {
  Scene scene({.enabled = sleep == Sleep::of_talus});
  const auto starts = drops<Scene::dimension>(boxes, seed);
  std::vector<typename Scene::Body*> poured;
  Pour result;
  const std::clock_t start = std::clock();
  const auto drop = [&](int number) {
    poured.push_back(&scene.drop(starts[number]));
    if (sleep == Sleep::none) scene.keep_awake(*poured.back());
  };
  const int steps = pour_steps(boxes, drop, [&] {
    scene.step();
    result.awake += scene.sleeper->awake();
  });
  result.time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  result.awake /= steps;
  for (const auto* box : poured) result.height += scene.place(*box)[Scene::dimension - 1] / boxes;
  return result;
}

/// Over seeds: the time of a pour over that with the engine's own sleeping and over that with talus's, in turn.
template <typename Scene>
void expect_faster_pour(std::string_view engine, int boxes, unsigned seeds) {
  std::vector<double> plain_times;
  std::vector<double> times;
  std::vector<double> over_own;
  std::vector<double> over_talus;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const double plain = pour<Scene>(boxes, seed, Sleep::none).time;
    const double own = pour<Scene>(boxes, seed, Sleep::of_engine).time;
    const double talus = pour<Scene>(boxes, seed, Sleep::of_talus).time;
    plain_times.push_back(plain);
    times.push_back(talus);
    over_talus.push_back(plain / talus);
    over_own.push_back(own / talus);
  }
  const MeanWithError ratio = mean_with_error(over_talus);
  const MeanWithError own_ratio = mean_with_error(over_own);
  fmt::print("| {} | {} | {} | {:.2f} | {:.2f} | {:.2f} ± {:.2f} | {:.2f} ± {:.2f} |\n", engine, boxes, seeds,
             mean(plain_times), mean(times), ratio.mean, ratio.error, own_ratio.mean, own_ratio.error);
  EXPECT_GT(ratio.mean, 1.5);
  EXPECT_GT(own_ratio.mean, 1.0);
}

}  // namespace talus::test

// Tests that other simulators publish, rebuilt from their numbers.

#include <algorithm>
#include <random>

#include "common/math/random.h"
#include "common/measure/support.h"
#include "tools/stress/stage.h"

namespace talus {
namespace {

constexpr double small = 0.1;  // radius of SimBenchmark's balls [m]
constexpr double ten_kilogram = 10.0 / (4.0 / 3.0 * std::numbers::pi * small * small * small);  // as a density

/// SimBenchmark's balls of 10 kg in a lattice, `apart` from each other, the lowest at height `low`; ground and balls
/// without friction.
Stage<3> simbenchmark(const StressCell& cell, int across, int layers, double apart, double low, double restitution,
                      double jitter) {
  const Material material{.density = ten_kilogram, .friction = 0.0, .restitution = restitution};
  Stage<3> stage(cell, material);
  stage.rate(1000.0);
  stage.scene.world.solver.restitution_threshold = 0.01;
  const int ball = stage.ball(small, material);
  std::mt19937_64 random(1);
  for (int layer = 0; layer < layers; ++layer)
    for (int i = 0; i < across; ++i)
      for (int j = 0; j < across; ++j)
        stage.body(ball, Vec3(apart * (i - 0.5 * (across - 1)), apart * (j - 0.5 * (across - 1)), low + apart * layer) +
                             uniform_within<3>(Vec3::Constant(jitter), random));
  return stage;
}

/// Root of the mean squared error of the energy over the run, as a share of the energy at the start.
std::vector<double> energy_error(const Stage<3>& stage, double seconds) {
  StressRun<3> run = stage.run();
  run.until(0.001);
  const double start = run.energy();
  double sum = 0.0;
  int steps = 0;
  run.until(seconds, [&] {
    const double error = run.energy() / start - 1.0;
    sum += error * error;
    ++steps;
  });
  return {std::sqrt(sum / steps)};
}

std::vector<double> bouncing(const StressCell& cell) {
  return energy_error(simbenchmark(cell, 7, 1, 0.5, small + 5.0, 1.0, 0.0), 20.0);
}

std::vector<double> elastic_666(const StressCell& cell) {
  return energy_error(simbenchmark(cell, 6, 6, 0.21, 1.101, 1.0, 1e-3), 5.0);
}

/// Root of the mean squared depth of overlap of touching pairs, sampled ten times a second.
std::vector<double> hard_666(const StressCell& cell) {
  StressRun<3> run = simbenchmark(cell, 6, 6, 0.21, 0.101, 0.0, 1e-3).run();
  const WorldDescription<3> description = simbenchmark(cell, 6, 6, 0.21, 0.101, 0.0, 1e-3).scene.world;
  double sum = 0.0;
  int pairs = 0;
  for (int sample = 1; sample <= 50; ++sample) {
    run.until(0.1 * sample);
    for (const Touch& touch : touching_pairs(description, run.states(), 0.0)) {
      sum += touch.distance * touch.distance;
      ++pairs;
    }
  }
  return {pairs == 0 ? 0.0 : std::sqrt(sum / pairs) / small};
}

}  // namespace

std::vector<StressCase> peer_cases() {
  const std::string_view conserved = "conserved at restitution 1; SimBenchmark plots it over the time step";
  std::vector<StressCase> cases;
  const auto add = [&](std::string name, std::string setup, std::vector<StressGate> gates,
                       std::vector<double> (*measure)(const StressCell&), std::string_view known) {
    StressCase each{.group = "peers", .name = std::move(name), .setup = std::move(setup), .gates = std::move(gates)};
    each.in_space = measure;
    if (!known.empty()) each.known = {{"", "", known}};
    cases.push_back(std::move(each));
  };
  add("simbenchmark-bouncing", "SimBenchmark: 49 balls of 0.1 m fall 5 m, restitution 1, 20 s at 1,000 steps a second",
      {{"error of the energy, share", "", 0.0, 0.05, conserved}}, bouncing,
      "Bullet takes the gap before an impact over the time step off the speed of the rebound, at 1,000 steps a second "
      "up "
      "to all of it");
  add("simbenchmark-elastic-666",
      "SimBenchmark: 216 balls of 0.1 m in a lattice fall 1 m, restitution 1, 5 s at 1,000 steps a second",
      {{"error of the energy, share", "", 0.0, 0.05, conserved}}, elastic_666,
      "impacts of many bodies at once gain and lose energy at restitution 1; talus check warns above 0.99");
  add("simbenchmark-666", "SimBenchmark: 216 balls of 0.1 m in a lattice collapse, no friction, 5 s",
      {{"overlap of pairs over the radius", "", 0.0, 0.01, "rigid bodies; a hundredth of the radius"}}, hard_666, {});
  return cases;
}

}  // namespace talus

#include "tools/run/speed_up.h"

#include <algorithm>

#include "common/measure/ensemble.h"
#include "common/policy/sleep_policy.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "common/world/stopwatch.h"
#include "tools/output/output.h"
#include "tools/run/backends.h"
#include "tools/run/processor_watch.h"

namespace talus {
namespace {

/// Mean processor time of a step [s], without the first step, in which the engine allocates. A mean and no sum: runs
/// that end once all bodies rest have different numbers of steps.
template <int Dim>
double seconds_of(const Scene<Dim>& scene, const std::string& backend) {
  Simulation<Dim> simulation(scene, make_world<Dim>(backend, scene.world), make_policy(scene));
  simulation.step();
  std::int64_t steps = 0;
  ProcessorWatch processor;
  for (; !simulation.finished(); ++steps) simulation.step();
  return processor.lap() / static_cast<double>(std::max<std::int64_t>(1, steps));
}

/// Where a round is long, how far the rounds are.
void tell_round(const SpeedUp& so_far, double elapsed, const SpeedUpParams& params) {
  constexpr double long_round = 5.0;  // [s]
  const auto rounds = static_cast<int>(so_far.own.size());
  const double seconds = elapsed / rounds;
  if (seconds < long_round || rounds >= params.least_rounds) return;
  print_message("round {} of {}: {:.2f} times as fast; about {:.0f} s left", rounds, params.least_rounds,
                so_far.ratios().back(), seconds * (params.least_rounds - rounds));
}

}  // namespace

std::vector<double> SpeedUp::ratios() const {
  std::vector<double> list;
  for (std::size_t round = 0; round < own.size(); ++round) list.push_back(other[round] / own[round]);
  return list;
}

template <int Dim>
SpeedUp measure_speed_up(const Scene<Dim>& own, const Scene<Dim>& other, const std::string& backend,
                         const SpeedUpParams& params) {
  SpeedUp result;
  Stopwatch watch;
  double elapsed = 0.0;
  for (int round = 0; round < params.most_rounds; ++round) {
    if (round >= params.least_rounds && elapsed >= params.most_seconds) break;
    // What comes second finds the caches and the allocator as the first left them.
    if (round % 2 == 0) result.own.push_back(seconds_of(own, backend));
    result.other.push_back(seconds_of(other, backend));
    if (round % 2 == 1) result.own.push_back(seconds_of(own, backend));
    elapsed += watch.lap();
    tell_round(result, elapsed, params);
  }
  return result;
}

template <int Dim>
int tell_speed_up(const Scene<Dim>& own, const Scene<Dim>& other, const std::string& backend) {
  flush_results();
  const SpeedUp measured = measure_speed_up(own, other, backend);
  const std::vector<double> ratios = measured.ratios();
  const auto [low, high] = std::minmax_element(ratios.begin(), ratios.end());
  print_result(
      "  {:.2f} times as fast as policy {} (median; {:.2f} to {:.2f} in {} rounds of processor time, nothing "
      "recorded: {:.3f} and {:.3f} ms a step)\n",
      median(ratios), other.policy.kind, *low, *high, ratios.size(), 1e3 * median(measured.own),
      1e3 * median(measured.other));
  return exit_codes::success;
}

template SpeedUp measure_speed_up(const Scene<2>&, const Scene<2>&, const std::string&, const SpeedUpParams&);
template SpeedUp measure_speed_up(const Scene<3>&, const Scene<3>&, const std::string&, const SpeedUpParams&);
template int tell_speed_up(const Scene<2>&, const Scene<2>&, const std::string&);
template int tell_speed_up(const Scene<3>&, const Scene<3>&, const std::string&);

}  // namespace talus

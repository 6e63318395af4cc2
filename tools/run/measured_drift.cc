#include "tools/run/measured_drift.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/measure/ensemble.h"
#include "common/scene/happened.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

/// Why drift cannot be measured after these events; empty: it can.
template <int Dim>
std::string obstruction(const Scene<Dim>& scene, std::span<const DoneEvent> done, double time) {
  if (still_driven(scene, done, time))
    return "an obstacle or gravity still moves by plan at the end, or the force of an event acts";
  if (world_at(scene, done, time).gravity <= 0.0) return "there is no gravity at the end";
  return {};
}

/// Without the bodies that lie outside the world: no new world takes them, nor removed ones there.
template <int Dim>
BodyStates<Dim> within_world(BodyStates<Dim> states, const UnitScale& units) {
  const double farthest = farthest_place(units);
  for (std::size_t body = 0; body < states.pose.size(); ++body) {
    if (states.pose[body].position.cwiseAbs().maxCoeff() <= farthest) continue;
    states.removed[body] = 1;
    states.pose[body] = {};
  }
  return states;
}

}  // namespace

template <int Dim>
WakeTest wake_all(const WorldDescription<Dim>& world, const std::string& backend, const BodyStates<Dim>& states,
                  const WakeTestParams& params) {
  return wake_test<Dim>(world_maker<Dim>(backend), judging_settings(world), states, params);
}

template <int Dim>
void require_measurable_drift(const Scene<Dim>& scene) {
  const double end = static_cast<double>(scene.steps()) * scene.world.dt;
  std::vector<DoneEvent> expected;
  for (int number = 0; number < std::ssize(scene.events); ++number)
    if (const double time = scene.events[number].time.value_or(0.0); time <= end) expected.push_back({number, time});
  std::ranges::stable_sort(expected, {}, &DoneEvent::time);
  if (const std::string why = obstruction<Dim>(scene, expected, end); !why.empty())
    throw std::invalid_argument(fmt::format("--measure-drift: drift cannot be measured: {}", why));
}

template <int Dim>
MeasuredDrift measure_drift(const Simulation<Dim>& simulation, const Scene<Dim>& scene, const std::string& backend,
                            const std::function<bool()>& stop) {
  MeasuredDrift drift;
  drift.missing = obstruction<Dim>(scene, simulation.done_events(), simulation.time());
  if (!drift.missing.empty()) return drift;
  const BodyStates<Dim> last = within_world(simulation.world().states(), simulation.world().units());
  const WorldDescription<Dim> world = world_at(scene, simulation.done_events(), simulation.time());
  drift.seconds = wake_time(world.gravity);
  const WakeTest test = wake_all<Dim>(world, backend, last, {.duration = drift.seconds, .stop = stop});
  if (stop && stop()) return {.missing = "interrupted"};
  const std::vector<double> asleep = of_sleepers(test, last);
  if (asleep.empty()) return {.missing = "no body sleeps at the end"};
  drift.bodies = static_cast<int>(asleep.size());
  const double extent = simulation.piles().typical_body().extent;
  drift.mean = mean(asleep) / extent;
  drift.p95 = quantile(asleep, 0.95) / extent;
  drift.max = quantile(asleep, 1.0) / extent;
  return drift;
}

template <int Dim>
std::vector<double> of_sleepers(const WakeTest& test, const BodyStates<Dim>& states) {
  std::vector<double> asleep;
  std::size_t present = 0;
  for (std::size_t body = 0; body < states.asleep.size(); ++body) {
    if (states.removed[body] != 0) continue;
    const double displacement = test.displacements[present++];
    if (states.asleep[body] != 0) asleep.push_back(displacement);
  }
  return asleep;
}

template <int Dim>
std::optional<DriftProbe> probe_end_drift(Simulation<Dim>& simulation, const Scene<Dim>& scene,
                                          const std::string& backend, double body_steps,
                                          const std::function<bool()>& stop) {
  constexpr double share = 0.25;
  constexpr double always_allowed = 2e4;  // body-steps
  const PolicyParams policy = policy_at(scene, simulation.done_events(), simulation.time());
  if (policy.tolerance().value_or(0.0) <= 0.0) return std::nullopt;
  if (!obstruction<Dim>(scene, simulation.done_events(), simulation.time()).empty()) return std::nullopt;
  const BodyStates<Dim> last = within_world(simulation.world().states(), simulation.world().units());
  const WorldDescription<Dim> world = world_at(scene, simulation.done_events(), simulation.time());
  std::vector<std::uint8_t> sleepers = last.asleep;
  for (std::size_t body = 0; body < sleepers.size(); ++body)
    if (last.removed[body] != 0) sleepers[body] = 0;
  const double extent = simulation.piles().typical_body().extent;
  const DriftProbeParams params{.extent = extent,
                                .unit = time_unit(extent, world.gravity),
                                .duration = wake_time(world.gravity),
                                .body_steps = std::max(share * body_steps, always_allowed),
                                .stop = stop};
  const DriftProbe probe = probe_drift<Dim>(world_maker<Dim>(backend), judging_settings(world), last, sleepers, params);
  if (probe.bodies == 0) return std::nullopt;
  simulation.set_probed_drift(probe.expected());
  return probe;
}

std::optional<Warning> drift_warning(double mean, int bodies, const PolicyParams& policy, std::int64_t step) {
  const double tolerance = policy.tolerance().value_or(0.0);
  if (tolerance <= 0.0 || mean <= tolerance) return std::nullopt;
  return Warning{.kind = WarningKind::drift, .step = step, .bodies = bodies, .value = mean};
}

template WakeTest wake_all(const WorldDescription<2>&, const std::string&, const BodyStates<2>&, const WakeTestParams&);
template WakeTest wake_all(const WorldDescription<3>&, const std::string&, const BodyStates<3>&, const WakeTestParams&);
template std::vector<double> of_sleepers(const WakeTest&, const BodyStates<2>&);
template std::vector<double> of_sleepers(const WakeTest&, const BodyStates<3>&);
template void require_measurable_drift(const Scene<2>&);
template void require_measurable_drift(const Scene<3>&);
template MeasuredDrift measure_drift(const Simulation<2>&, const Scene<2>&, const std::string&,
                                     const std::function<bool()>&);
template MeasuredDrift measure_drift(const Simulation<3>&, const Scene<3>&, const std::string&,
                                     const std::function<bool()>&);
template std::optional<DriftProbe> probe_end_drift(Simulation<2>&, const Scene<2>&, const std::string&, double,
                                                   const std::function<bool()>&);
template std::optional<DriftProbe> probe_end_drift(Simulation<3>&, const Scene<3>&, const std::string&, double,
                                                   const std::function<bool()>&);

}  // namespace talus

#include "tools/run/measured_drift.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "common/measure/ensemble.h"
#include "common/scene/happened.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

/// Why drift cannot be measured after these events; empty: it can.
template <int Dim>
std::string obstruction(const Scene<Dim>& scene, std::span<const DoneEvent> done, double time) {
  if (still_moves(scene, done, time)) return "an obstacle or gravity still moves by plan at the end";
  if (world_at(scene, done, time).gravity <= 0.0) return "there is no gravity at the end";
  return {};
}

/// Without the bodies that lie outside the world: no new world takes them, nor removed ones there.
template <int Dim>
BodyStates<Dim> within_world(BodyStates<Dim> states) {
  for (std::size_t body = 0; body < states.pose.size(); ++body) {
    if (states.pose[body].position.cwiseAbs().maxCoeff() <= farthest_place) continue;
    states.removed[body] = 1;
    states.pose[body] = {};
  }
  return states;
}

/// Of the bodies that sleep in a state, ascending by index [m].
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

}  // namespace

template <int Dim>
WakeTest wake_all(const WorldDescription<Dim>& world, const std::string& backend, const BodyStates<Dim>& states,
                  const WakeTestParams& params) {
  const WorldMaker<Dim> maker = [&](const WorldDescription<Dim>& description) {
    return make_world<Dim>(backend, description);
  };
  return wake_test<Dim>(maker, reference_settings(world), states, params);
}

template <int Dim>
void require_measurable_drift(const Scene<Dim>& scene) {
  const double end = static_cast<double>(scene.steps()) * scene.world.dt;
  std::vector<DoneEvent> all;
  for (int number = 0; number < std::ssize(scene.events); ++number) all.push_back({number, end});
  if (const std::string why = obstruction<Dim>(scene, all, end); !why.empty())
    throw std::invalid_argument(fmt::format("--measure-drift: drift cannot be measured: {}", why));
}

template <int Dim>
MeasuredDrift measure_drift(const Simulation<Dim>& simulation, const Scene<Dim>& scene, const std::string& backend,
                            const std::function<bool()>& stop) {
  MeasuredDrift drift;
  drift.missing = obstruction<Dim>(scene, simulation.done_events(), simulation.time());
  if (!drift.missing.empty()) return drift;
  const BodyStates<Dim> last = within_world(simulation.world().states());
  const WorldDescription<Dim> world = world_at(scene, simulation.done_events(), simulation.time());
  drift.seconds = wake_time(world.gravity);
  const WakeTest test = wake_all<Dim>(world, backend, last, {.duration = drift.seconds, .stop = stop});
  if (stop && stop()) return {.missing = "interrupted"};
  const std::vector<double> asleep = of_sleepers(test, last);
  if (asleep.empty()) return {.missing = "no body sleeps at the end"};
  drift.bodies = static_cast<int>(asleep.size());
  drift.mean = mean(asleep);
  drift.p95 = quantile(asleep, 0.95);
  drift.max = quantile(asleep, 1.0);
  return drift;
}

double tolerance_of(const PolicyParams& policy) { return policy.kind == "adaptive" ? policy.adaptive.tolerance : 0.0; }

template <int Dim>
std::optional<Warning> warning_of(const MeasuredDrift& drift, const Scene<Dim>& scene, double extent,
                                  std::int64_t step) {
  const double tolerance = tolerance_of(scene.policy);
  if (tolerance <= 0.0 || !drift.missing.empty() || drift.mean <= tolerance * extent) return std::nullopt;
  return Warning{.kind = WarningKind::drift, .step = step, .bodies = drift.bodies, .value = drift.mean / extent};
}

template WakeTest wake_all(const WorldDescription<2>&, const std::string&, const BodyStates<2>&, const WakeTestParams&);
template WakeTest wake_all(const WorldDescription<3>&, const std::string&, const BodyStates<3>&, const WakeTestParams&);
template void require_measurable_drift(const Scene<2>&);
template void require_measurable_drift(const Scene<3>&);
template MeasuredDrift measure_drift(const Simulation<2>&, const Scene<2>&, const std::string&,
                                     const std::function<bool()>&);
template MeasuredDrift measure_drift(const Simulation<3>&, const Scene<3>&, const std::string&,
                                     const std::function<bool()>&);
template std::optional<Warning> warning_of(const MeasuredDrift&, const Scene<2>&, double, std::int64_t);
template std::optional<Warning> warning_of(const MeasuredDrift&, const Scene<3>&, double, std::int64_t);

}  // namespace talus

#include "lcmtypes/stats_message.h"

#include <algorithm>
#include <numbers>

#include "common/policy/sleep_policy.h"
#include "common/world/energy.h"
#include "lcmtypes/message.h"

namespace talus {

using talus_lcm::talus_stats;

template <int Dim>
talus_stats to_stats(const Frame<Dim>& frame) {
  const BodyStates<Dim>& states = frame.world.states();
  talus_stats message{};
  const auto removed = std::count(states.removed.begin(), states.removed.end(), 1);
  message.awake = static_cast<std::int32_t>(frame.world.awake().size());
  message.asleep = states.size() - message.awake - static_cast<std::int32_t>(removed);
  message.kinetic_energy = kinetic_energy(frame.world);
  message.planned = frame.bodies_planned;
  message.appeared = states.size();
  const std::optional<ToldDrift> drift = told_drift(frame);
  message.drift_estimate = drift ? drift->drift : -1.0;
  message.checked_share = drift ? drift->checked_share : 0.0;
  message.overlap = frame.overlap.deepest;
  message.overlap_share = frame.overlap.share;
  message.slope = -1.0;
  for (const Warning& warning : frame.warnings) {
    message.warning_kind.push_back(static_cast<std::int8_t>(warning.kind));
    message.warning_step.push_back(warning.step);
    message.warning_body.push_back(warning.body);
    message.warning_bodies.push_back(warning.bodies);
    message.warning_value.push_back(warning.value);
    message.warning_text.push_back(account(warning));
  }
  message.warning_count = static_cast<std::int32_t>(frame.warnings.size());
  return message;
}
template talus_stats to_stats<2>(const Frame<2>&);
template talus_stats to_stats<3>(const Frame<3>&);

void set_phase_times(const PhaseTimes& sum, std::int64_t steps, talus_stats& message) {
  const auto mean = [&](double seconds) { return static_cast<float>(1e3 * seconds / static_cast<double>(steps)); };
  message.ms_emit = mean(sum.emit);
  message.ms_step = mean(sum.step);
  message.ms_collide = mean(sum.collide);
  message.ms_solve = mean(sum.solve);
  message.ms_read = mean(sum.read);
  message.ms_count = mean(sum.count);
  message.ms_decide = mean(sum.decide);
  message.ms_apply = mean(sum.apply);
  message.ms_observe = mean(sum.observe);
}

PhaseTimes phase_times_of(const talus_stats& message) {
  return {.emit = message.ms_emit,
          .step = message.ms_step,
          .collide = message.ms_collide,
          .solve = message.ms_solve,
          .read = message.ms_read,
          .count = message.ms_count,
          .decide = message.ms_decide,
          .apply = message.ms_apply,
          .observe = message.ms_observe};
}

std::optional<double> drift_of(const talus_stats& message) {
  return message.drift_estimate >= 0.0 ? std::optional(message.drift_estimate) : std::nullopt;
}

std::vector<Warning> warnings_of(const talus_stats& message) {
  std::vector<Warning> warnings;
  for (std::size_t i = 0; i < message.warning_kind.size(); ++i) {
    warnings.push_back({.kind = static_cast<WarningKind>(message.warning_kind[i]),
                        .step = message.warning_step[i],
                        .body = message.warning_body[i],
                        .bodies = message.warning_bodies[i],
                        .value = message.warning_value[i]});
  }
  return warnings;
}

std::string_view range_fault(const talus_stats& m) {
  if (!header_holds(m)) return "header out of range";
  if (m.awake < 0 || m.asleep < 0) return "negative count";
  if (m.kinetic_energy < 0) return "kinetic energy out of range";
  if (m.planned < 0 || m.appeared < 0) return "negative count";
  if (!(m.drift_estimate >= 0.0 || m.drift_estimate == -1.0)) return "estimate of drift out of range";
  if (!(m.checked_share >= 0.0 && m.checked_share <= 1.0)) return "share out of range";
  if (!(m.overlap >= 0.0)) return "overlap out of range";
  if (!(m.overlap_share >= 0.0 && m.overlap_share <= 1.0)) return "share out of range";
  if (!((m.slope >= 0.0 && m.slope <= std::numbers::pi / 2.0) || m.slope == -1.0)) return "slope out of range";
  if (m.warning_count > talus_stats::PASSED + 1) return "more warnings than kinds";
  const auto known = [](auto kind) { return kind >= talus_stats::BELOW_GROUND && kind <= talus_stats::PASSED; };
  if (!std::all_of(m.warning_kind.begin(), m.warning_kind.end(), known)) return "unknown kind of warning";
  if (std::any_of(m.warning_step.begin(), m.warning_step.end(), is_negative)) return "negative step of a warning";
  if (std::any_of(m.warning_bodies.begin(), m.warning_bodies.end(), is_negative)) return "negative count";
  if (!std::all_of(m.warning_body.begin(), m.warning_body.end(), is_index_or_none)) return "body out of range";
  for (const float value : {m.ms_emit, m.ms_step, m.ms_collide, m.ms_solve, m.ms_read, m.ms_count, m.ms_decide,
                            m.ms_apply, m.ms_observe, m.real_time_factor}) {
    if (value < 0) return "time out of range";
  }
  if (m.queued_bytes < 0 || m.dropped < 0) return "negative count";
  return {};
}

}  // namespace talus

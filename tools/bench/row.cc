#include "tools/bench/row.h"

#include <array>
#include <limits>

namespace talus {

std::span<const char* const> measure_names() {
  // Of a timed run; lengths in metres, times in seconds unless the name says otherwise, _D: over D.
  static constexpr std::array names = {
      "seconds", "wall_seconds", "pour_seconds", "calm_seconds", "poured_at", "last_100_ms", "rule_ms", "mean_awake",
      "steps", "bodies", "asleep_at_end",
      // Motion against the baseline, over all frames that both have (motion_error.h); floor: the baseline against its
      // twin; ceiling: against another seed.
      "relative", "left_out", "absolute", "floored", "R", "S", "turning", "relative_floor", "R_floor", "S_floor",
      "R_ceiling", "S_ceiling", "R_skill", "S_skill", "diverges_at",
      // Ratio of sums after 10, 20 and 30 frames from forks (short_horizon.h), and the same of the full run itself.
      "horizon_R_10", "horizon_R_30", "horizon_R_30_floor", "horizon_mean_30_D", "horizon_mean_30_D_floor",
      // Shape over the twins: own mean and standard deviation, distance of the means from the baseline's over D.
      "twins", "centre", "centre_sd", "centre_off_D", "r50", "r50_sd", "r50_off_D", "r95", "r95_sd", "r95_off_D",
      "peak", "peak_sd", "peak_off_D", "angle_deg", "angle_deg_sd", "angle_off_deg", "profile_rms_D",
      "profile_rms_D_floor", "ks_z", "ks_z_p", "ks_z_floor", "w1_z", "w1_z_p", "w1_z_floor", "ks_r", "ks_r_p",
      "ks_r_floor", "w1_r", "w1_r_p", "w1_r_floor",
      // The last state (support.h), and what became of those of all twins once woken (wake_test.h): means, of drift
      // the standard deviation too; excess: beyond the baseline's.
      "floating", "penetration_p99_D", "penetration_max_D", "drift_mean_D", "drift_mean_D_sd", "drift_mean_excess_D",
      "drift_far", "drift_far_excess", "wake_energy_mgD", "creep_per_minute", "settling_per_minute",
      // Work (work.h).
      "work_skipped", "oracle_001", "oracle_005", "oracle_02", "oracle_005_pour", "oracle_005_calm", "stops_at",
      "asleep_at"};
  return names;
}

double value_of(const Values& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

}  // namespace talus

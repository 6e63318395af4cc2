#pragma once
// What benchmarks measure: each measure declared once. A measure is named by a text that is checked when it compiles.

#include <array>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// One number of a run or of an ensemble of runs. Beside a measure NAME may stand NAME_sd (standard deviation of one
/// run), NAME_floor (what a perturbation by a micrometre gives), NAME_min and NAME_max (of the rounds).
struct Measure {
  /// Column of results.csv, key of results.json and rows.jsonl.
  std::string_view name;
  /// Column of tables, with the unit.
  std::string_view heading;
  /// Significant digits in tables.
  int digits = 3;
  /// One sentence for docs/files.md; empty for the companions named above.
  std::string_view meaning;
};

inline constexpr auto measures = std::to_array<Measure>({
    // Of the rounds.
    {"speed_up", "speed-up over full", 3, "processor time of the full run over this one's, within a round"},
    {"speed_up_min", "smallest", 3, ""},
    {"speed_up_max", "largest", 3, ""},
    {"speed_up_pour", "while pouring", 3, "the same until the last body appears"},
    {"speed_up_last_100", "over the last 100 steps", 3, "the same over the last hundred steps"},
    // Of a timed run.
    {"seconds", "time [s]", 3, "processor time of all steps but the first, nothing recorded"},
    {"seconds_min", "smallest", 3, ""},
    {"seconds_max", "largest", 3, ""},
    {"wall_seconds", "wall time [s]", 3, "wall time of the same steps"},
    {"pour_seconds", "time of the pour [s]", 3, "processor time until the last body appears"},
    {"after_pour_seconds", "time after the pour [s]", 3, "processor time from then on"},
    {"poured_at", "poured at [s]", 3, "simulated time at which the last body appears"},
    {"reached_rate", "bodies per second", 3, "bodies over the simulated time of the pour"},
    {"last_100_ms", "last 100 steps [ms]", 3, "mean processor time of the last hundred steps"},
    {"rule_ms", "policy [ms/step]", 3, "counting piles and deciding, mean per step"},
    {"mean_awake", "mean awake", 4, "awake bodies, mean over the steps"},
    {"steps", "steps", 6, "steps of the run"},
    {"bodies", "bodies", 6, "bodies at the end"},
    {"asleep_at_end", "asleep at end", 6, "bodies asleep at the end"},
    // Motion against the baseline, frame by frame (common/measure/motion_error.h).
    {"relative", "paper's e", 3, "the paper's relative error (section 4.2.4): mean of |m - m~| / |m|"},
    {"relative_floor", "floor", 3, ""},
    {"left_out", "left out", 2, "share of bodies with m = 0, which the paper's error leaves out"},
    {"absolute", "E / m0", 3, "the paper's absolute error over the motion of one frame of free fall"},
    {"floored", "floored", 3, "mean of |m - m~| / max(|m|, m0)"},
    {"turning", "turning", 3, "R of the rotations"},
    {"R", "R", 3, "sum |m - m~| / (sum |m| + N m0)"},
    {"R_floor", "floor", 3, ""},
    {"R_ceiling", "other seed", 3, "the same between the full runs of two seeds"},
    {"R_skill", "R skill", 2, "place of R between its floor (0) and that of another seed (1)"},
    {"S", "S", 3, "sum |m - m~| / (sum |m| + sum |m~| + N m0)"},
    {"S_floor", "floor", 3, ""},
    {"S_ceiling", "other seed", 3, "the same between the full runs of two seeds"},
    {"S_skill", "S skill", 2, "place of S between its floor (0) and that of another seed (1)"},
    {"diverges_at", "perturbed run parts at [s]", 3, "time at which a perturbed full run has parted from the full run"},
    // Errors a few frames after forks (common/measure/short_horizon.h).
    {"horizon_R_10", "R after 10 frames", 3, "R over ten frames from forks at which the full simulation takes over"},
    {"horizon_R_30", "R after 30 frames", 3, "the same over thirty frames"},
    {"horizon_R_30_floor", "floor", 3, ""},
    {"horizon_mean_30_D", "distance after 30 frames / D", 3,
     "mean distance of a body's two places after thirty frames"},
    {"horizon_mean_30_D_floor", "floor", 3, ""},
    // Shape over an ensemble of seeds (common/measure/shape_statistics.h), distances from the baseline.
    {"runs", "runs", 3, "runs of the ensemble, one per seed"},
    {"centre", "centre [m]", 3, "height of the centre of mass"},
    {"centre_sd", "deviation", 2, ""},
    {"centre_off_D", "centre off / D", 3, "its mean less the baseline's"},
    {"r50", "r50 [m]", 3, "radius that holds half of the bodies"},
    {"r50_sd", "deviation", 2, ""},
    {"r50_off_D", "r50 off / D", 3, "its mean less the baseline's"},
    {"r95", "r95 [m]", 3, "radius that holds 95 % of the bodies"},
    {"r95_sd", "deviation", 2, ""},
    {"r95_off_D", "r95 off / D", 3, "its mean less the baseline's"},
    {"peak", "peak [m]", 3, "height of the highest point of the surface"},
    {"peak_sd", "deviation", 2, ""},
    {"peak_off_D", "peak off / D", 3, "its mean less the baseline's"},
    {"angle_deg", "angle [°]", 3, "angle of repose of the fitted slope"},
    {"angle_deg_sd", "deviation", 2, ""},
    {"angle_off_deg", "angle off [°]", 3, "its mean less the baseline's"},
    {"profile_rms_D", "profile off (rms) / D", 3, "rms difference of the mean height profiles"},
    {"profile_rms_D_floor", "floor", 3, ""},
    {"ks_z", "KS(z)", 3, "Kolmogorov-Smirnov distance of the heights of bodies"},
    {"ks_z_floor", "floor", 3, ""},
    {"ks_z_p", "p of KS(z)", 2, "share of permutations of runs with a larger distance"},
    {"w1_z", "W1(z) [m]", 3, "Wasserstein distance of the heights of bodies"},
    {"w1_z_floor", "floor", 3, ""},
    {"w1_z_p", "p of W1(z)", 2, "share of permutations of runs with a larger distance"},
    {"ks_r", "KS(r)", 3, "Kolmogorov-Smirnov distance of the radii of bodies"},
    {"ks_r_floor", "floor", 3, ""},
    {"ks_r_p", "p of KS(r)", 2, "share of permutations of runs with a larger distance"},
    {"w1_r", "W1(r) [m]", 3, "Wasserstein distance of the radii of bodies"},
    {"w1_r_floor", "floor", 3, ""},
    {"w1_r_p", "p of W1(r)", 2, "share of permutations of runs with a larger distance"},
    // The last state (common/measure/support.h), and its drift once all are woken (common/measure/wake_test.h).
    {"floating", "floating", 3, "sleeping bodies without a chain of contacts to the ground"},
    {"penetration_p99_D", "penetration 99 % / D", 2, "depth that 99 % of touching pairs do not exceed"},
    {"penetration_max_D", "largest penetration / D", 2, "depth of the deepest pair"},
    {"drift_mean_D", "drift after waking / D", 3, "mean distance that bodies move after all are woken"},
    {"drift_mean_D_sd", "deviation", 2, ""},
    {"drift_mean_excess_D", "drift beyond full / D", 3, "the same less the baseline's"},
    {"drift_far", "share above 0.1 D", 2, "share of bodies that drift by more than 0.1 D"},
    {"drift_far_excess", "share above 0.1 D beyond full", 2, "the same less the baseline's"},
    {"wake_energy_mgD", "wake energy / mgD", 2, "largest kinetic energy per body after waking"},
    {"creep_per_minute", "creep per minute", 2, "speed of the slow motion after waking, per minute"},
    {"settling_per_minute", "settling per minute", 2,
     "share of its height that the pile loses per minute after the pour"},
    // Work (common/measure/work.h).
    {"work_skipped", "work skipped", 3, "share of body-steps not simulated"},
    {"hindsight_001", "hindsight, 0.01 D", 3,
     "bodies over those that move by 0.01 D within half a second, in the full run"},
    {"hindsight_005", "hindsight", 3, "bodies over those that move by 0.05 D within half a second, in the full run"},
    {"hindsight_02", "hindsight, 0.2 D", 3,
     "bodies over those that move by 0.2 D within half a second, in the full run"},
    {"hindsight_005_pour", "hindsight while pouring", 3, "hindsight until the last body appears"},
    {"hindsight_005_after_pour", "hindsight after the pour", 3, "hindsight from then on"},
    {"stops_at", "last body stops [s]", 3, "from then on no body moves by 0.01 D within half a second"},
    {"asleep_at", "all asleep from [s]", 3, "from then on every body sleeps"},
    // Of one run of `talus bench truth` (tools/bench/truth_run.h).
    {"centre_poured", "centre at the end of the pour [m]", 3,
     "height of the centre of mass when the last body appears"},
    {"spill", "spilled", 3, "bodies outside the container"},
    {"all_asleep", "all asleep", 1, "1 where every body sleeps at the end"},
    {"estimate_D", "estimated drift / D", 2, "drift of the sleeping bodies as the run estimates it at the end"},
    {"estimate_most_D", "at most", 2, "the same should the motion go on at its speed"},
    {"drift_slept_D", "drift of the sleeping / D", 2,
     "mean distance that the sleeping bodies move after all are woken"},
    {"awake_checked", "awake in checks", 3, "awake bodies that a stability check woke, mean over the steps"},
    {"awake_at_end", "awake at end", 3, "awake bodies at the end"},
    {"moving_at_end", "moving at end", 3, "bodies that then move as at the moments below"},
    {"awake_sampled", "awake at moments", 3, "awake bodies, mean over moments of the run"},
    {"moving_sampled", "moving at moments", 3,
     "bodies of which a point moves by more than 0.05 D within half a second with all awake, mean over the same "
     "moments"},
});

/// A measure of the table. `MeasureId id = "centre"` with a name that the table does not have does not compile.
class MeasureId {
 public:
  consteval MeasureId(const char* name) : index_(find(name)) {}  // NOLINT(google-explicit-constructor)

  /// The measure of this name found at run time; throws std::logic_error where there is none.
  static constexpr MeasureId named(std::string_view name) { return MeasureId(find(name)); }

  /// The companion "NAME" + suffix, as in `id.with("_floor")`; throws std::logic_error where there is none.
  MeasureId with(std::string_view suffix) const { return named(std::string(info().name).append(suffix)); }

  /// All measures, in the order of the table.
  static std::vector<MeasureId> all();

  constexpr std::size_t index() const { return index_; }
  constexpr const Measure& info() const { return measures[index_]; }

 private:
  explicit constexpr MeasureId(std::size_t index) : index_(index) {}
  static constexpr std::size_t find(std::string_view name) {
    for (std::size_t i = 0; i < measures.size(); ++i)
      if (measures[i].name == name) return i;
    throw std::logic_error("no measure of this name: " + std::string(name));
  }

  std::size_t index_;
};

/// A number per measure; NaN for what was not measured.
class Values {
 public:
  Values() { numbers_.fill(std::numeric_limits<double>::quiet_NaN()); }
  double operator[](MeasureId id) const { return numbers_[id.index()]; }
  double& operator[](MeasureId id) { return numbers_[id.index()]; }

  /// Measures whose number is finite, in the order of the table.
  std::vector<MeasureId> measured() const;
  bool empty() const { return measured().empty(); }

 private:
  std::array<double, measures.size()> numbers_{};
};

/// A number for a table: "-" for what was not measured.
std::string shown(double value, int digits = 3);

/// The value with the digits of its measure.
std::string shown(const Values& values, MeasureId id);

/// "1.37 (1.35-1.68)": with the smallest and the largest of the rounds.
std::string shown_with_range(const Values& values, MeasureId id);

/// "1.37 ± 0.05": with the deviation of one run.
std::string shown_with_deviation(const Values& values, MeasureId id);

/// "1.37 / 1.35": with the measure's floor.
std::string shown_with_floor(const Values& values, MeasureId id);

}  // namespace talus

#pragma once
// One run of a benchmark, and what is measured of it.

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/read_scene.h"

namespace talus {

/// In the place of a policy: full at finer settings, reference_scene().
inline constexpr std::string_view reference_policy = "reference";

struct BenchCase {
  std::filesystem::path scene;
  std::string backend;
  std::string policy;                 // a policy, or reference_policy
  std::vector<std::string> settings;  // PATH=VALUE, beside policy and seed
  int seed = 1;

  bool operator==(const BenchCase&) const = default;

  std::string scene_name() const { return scene.stem().string(); }
  /// Whether sleep decides nothing, so that settings of a policy change nothing.
  bool is_baseline() const { return policy == "full" || policy == "engine" || policy == reference_policy; }
};

/// Without those of policies.
std::vector<std::string> settings_of_world(const std::vector<std::string>& settings);

/// The scene with policy, settings and seed. Nothing is random in a scene without sources: there the first body is
/// moved by a micrometre a seed beyond the first. Throws SceneErrors.
AnyScene load(const BenchCase& bench_case);

/// Numbers of a run; NaN for what was not measured.
struct BenchNumbers {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double seconds = none;
  double wall_seconds = none;
  double steps = none;
  double bodies = none;
  double mean_awake = none;
  double asleep_at_end = none;
  double centre_height = none;
  double r50 = none;
  double drift = none;
  double motion_error = none;
  // In comparison with other runs of the same scene, engine and settings.
  double speed_up = none;
  double centre_error = none;
  double centre_error_se = none;
  double r50_error = none;
  double r50_error_se = none;
};

/// A column of bench.csv; docs/files.md has the same words.
struct BenchColumn {
  std::string_view name;
  double BenchNumbers::*number;
  std::string_view meaning;
};

inline constexpr auto bench_columns = std::to_array<BenchColumn>({
    {"seconds", &BenchNumbers::seconds,
     "processor time of the thread that steps, without the first step and with nothing recorded [s]"},
    {"wall_seconds", &BenchNumbers::wall_seconds, "wall time of the same steps [s]"},
    {"steps", &BenchNumbers::steps, "steps of the run"},
    {"bodies", &BenchNumbers::bodies, "bodies at the end"},
    {"mean_awake", &BenchNumbers::mean_awake, "awake bodies, mean over the steps"},
    {"asleep_at_end", &BenchNumbers::asleep_at_end, "bodies asleep at the end"},
    {"centre_height_m", &BenchNumbers::centre_height,
     "height of the pile's centre of mass above the ground at the end"},
    {"r50_m", &BenchNumbers::r50, "radius that holds half of the pile's bodies at the end"},
    {"drift_D", &BenchNumbers::drift, "with `--drift`: mean distance that bodies move once all are woken [D]"},
    {"motion_error", &BenchNumbers::motion_error,
     "with `--motion-error`: the paper's relative error against full, mean over the frames"},
    {"speed_up", &BenchNumbers::speed_up, "processor time of full over this run's, at the same seed and settings"},
    {"centre_error_percent", &BenchNumbers::centre_error,
     "centre_height_m less the mean of the reference, in per cent of it"},
    {"centre_error_se", &BenchNumbers::centre_error_se, "standard error of the reference's mean, in per cent of it"},
    {"r50_error_percent", &BenchNumbers::r50_error, "the same of r50_m"},
    {"r50_error_se", &BenchNumbers::r50_error_se, "the same of r50_m"},
});

/// A frame of output of a run.
struct BenchFrame {
  double time = 0.0;          // [s]
  double seconds = 0.0;       // processor time
  double motion_error = 0.0;  // the paper's relative error; NaN where no body moved
};

struct BenchRow {
  BenchCase run;
  BenchNumbers numbers;
  std::string end_hash;
  std::vector<BenchFrame> frames;
  std::string failure;  // empty: the run was measured
};

/// What is measured beside time and shape; each costs further runs.
struct BenchExtras {
  bool drift = false;
  bool motion_error = false;
  bool frames = false;  // with motion_error
};

/// Runs a case without observers, so that its time is that of the simulation. The motion error of full itself is that
/// of a run whose first source is moved by a micrometre.
BenchRow bench_run(const BenchCase& bench_case, const BenchExtras& extras);

/// A measured row as one line, and back; the case does not travel.
std::string line_of(const BenchRow& row);
BenchRow row_of(const BenchCase& bench_case, const std::string& line);

}  // namespace talus

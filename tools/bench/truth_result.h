#pragma once
// What the runs of a cell of `talus bench truth` show, and what of it is beyond the limits.

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "tools/bench/measure.h"

namespace talus {

/// How far the mean of independent runs is from that of other independent runs.
struct Bias {
  double difference = std::numeric_limits<double>::quiet_NaN();
  /// Over the baseline's mean, without its sign [%].
  double percent = std::numeric_limits<double>::quiet_NaN();
  /// Over its standard error, to which the scatter of both sides adds. Infinite where neither side scatters.
  double errors = std::numeric_limits<double>::quiet_NaN();
};

/// Numbers that are not finite are left out; all NaN where one side has fewer than two others.
Bias bias_of(std::span<const double> runs, std::span<const double> baseline);

/// Whether a bias is both larger than `percent` and resolved, by more than `errors` standard errors.
bool is_beyond(const Bias& bias, double percent, double errors);

/// Processor time of slow runs over that of fast ones, seed by seed.
struct TimeRatio {
  double middle = std::numeric_limits<double>::quiet_NaN();  // median
  double least = std::numeric_limits<double>::quiet_NaN();
  double most = std::numeric_limits<double>::quiet_NaN();
};

/// Runs of a cell on one engine.
struct TruthRuns {
  std::string cell;
  std::string backend;
  int dimension = 2;
  double friction = 0.6;
  /// By seed; each three of one length.
  std::vector<Values> full;
  std::vector<Values> reference;
  std::vector<Values> adaptive;
};

/// What a cell is held against.
struct TruthLimits {
  double drift = 0.05;          // beyond full's, mean [D]; 95 % of the runs: twice that
  double centre_percent = 3.0;  // of the reference's centre; beyond the limit only with `errors`
  double poured_percent = 5.0;  // the same at the end of the pour, in 3D and from friction 0.35 on
  double errors = 2.0;          // standard errors
};

/// Numbers of a cell; NaN for what was not measured.
struct TruthResult {
  Bias centre;            // of adaptive against the reference
  Bias centre_from_full;  // against full
  Bias poured;            // centre at the end of the pour
  Bias r50;
  Bias r95;
  Bias spill;
  Bias poured_from_full;
  Bias spill_from_full;
  double spill_reference = 0.0;  // mean [bodies]
  double drift = 0.0;            // beyond full's, mean [D]
  double drift_95 = 0.0;         // 95 % of the runs have no more [D]
  double drift_full = 0.0;       // [D]
  double estimate = 0.0;         // of the sleeping bodies' drift, by the run itself [D]
  double drift_slept = 0.0;      // of these bodies, over the runs with an estimate [D]
  double floating = 0.0;         // mean
  double asleep = 0.0;           // share of runs
  double awake = 0.0;            // mean over the run
  double awake_ratio = 0.0;      // awake over moving bodies, at the same moments
  double awake_errors = 0.0;     // their difference, in standard errors
  double awake_checked = 0.0;    // in stability checks, mean over the run
  double awake_at_end = 0.0;
  double moving_at_end = 0.0;
  TimeRatio speed_up;  // over full
  TimeRatio speed_up_reference;
  /// The largest of the measures over their limits: above 1 the cell is red.
  double severity = 0.0;
  /// Names of the measures beyond their limits, largest first.
  std::vector<std::string> beyond;
  /// For each of them in turn, what the other measures say of its cause.
  std::vector<std::string> reasons;
};

/// How estimates compare with the drift measured afterwards.
struct EstimateScore {
  int runs = 0;          // with an estimate
  int near = 0;          // of these, within a factor of 2 of the drift
  int claims = 0;        // runs whose estimate is within the tolerance at most
  int false_claims = 0;  // of these, with a drift above it
  int too_low = 0;       // claims with a drift above twice the estimate
};

/// Whether an estimate is within a factor of 2 of the drift.
bool is_near(double estimate, double drift);

EstimateScore estimate_score(std::span<const Values> runs, double tolerance);

TruthResult truth_result(const TruthRuns& runs, const TruthLimits& limits = {});

}  // namespace talus

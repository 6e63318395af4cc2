#include "tools/bench/truth_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/measure/ensemble.h"

namespace talus {
namespace {

using RunValues = std::vector<Values>;

/// The finite numbers of a measure, by seed.
std::vector<double> numbers_of(const RunValues& runs, MeasureId id) {
  std::vector<double> numbers;
  for (const Values& values : runs)
    if (std::isfinite(values[id])) numbers.push_back(values[id]);
  return numbers;
}

/// NaN where it was not measured.
double mean_over(const RunValues& runs, MeasureId id) {
  const std::vector<double> numbers = numbers_of(runs, id);
  return numbers.empty() ? std::numeric_limits<double>::quiet_NaN() : mean(numbers);
}

Bias bias_over(const RunValues& runs, const RunValues& baseline, MeasureId id) {
  return bias_of(numbers_of(runs, id), numbers_of(baseline, id));
}

TimeRatio time_ratio(const RunValues& slow, const RunValues& fast) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(slow.size(), fast.size()); ++i)
    ratios.push_back(slow[i]["seconds"] / fast[i]["seconds"]);
  if (ratios.empty()) return {};
  return {.middle = median(ratios), .least = std::ranges::min(ratios), .most = std::ranges::max(ratios)};
}

double variance_of_mean(std::span<const double> numbers) {
  const double middle = mean(numbers);
  double squares = 0.0;
  for (const double number : numbers) squares += (number - middle) * (number - middle);
  const auto count = static_cast<double>(numbers.size());
  return squares / (count - 1.0) / count;
}

/// Over the limit only when the bias is both large and resolved.
double over_limit(const Bias& bias, double percent, double errors) {
  return std::min(std::abs(bias.percent) / percent, std::abs(bias.errors) / errors);
}

/// Measures over their limits.
std::vector<std::pair<double, std::string>> over_limits(const TruthResult& result, const TruthRuns& runs,
                                                        const TruthLimits& limits) {
  std::vector<std::pair<double, std::string>> over = {
      {result.drift / limits.drift, "drift"},
      {result.drift_95 / (2.0 * limits.drift), "drift 95 %"},
      {over_limit(result.centre, limits.centre_percent, limits.errors), "centre"},
      {result.floating > 0.0 ? 1.0 + result.floating : 0.0, "floating"},
      {result.asleep < 1.0 ? 2.0 - result.asleep : 0.0, "not asleep"},
      {std::min(result.awake_ratio, result.awake_errors / limits.errors), "awake"}};
  if (runs.dimension == 3 || runs.friction >= 0.35)
    over.emplace_back(over_limit(result.poured, limits.poured_percent, limits.errors), "poured");
  if (std::abs(result.spill.difference) >= 0.5)
    over.emplace_back(std::abs(result.spill.errors) / limits.errors, "spill");
  return over;
}

/// "full runs differ from the reference by as much", or by how much adaptive differs from full.
std::string reason_of_bias(const Bias& from_full, double percent, const TruthLimits& limits) {
  if (std::isnan(from_full.percent)) return "not measured for full";
  const std::string difference =
      fmt::format("{:+.1f} % from full, {:.1f} standard errors", from_full.percent, std::abs(from_full.errors));
  return is_beyond(from_full, percent, limits.errors) ? "the policy: " + difference
                                                      : "the engine's default step, which full has too: " + difference;
}

/// What the other measures of a cell say of the cause of one beyond its limit.
std::string reason_of(const std::string& name, const TruthResult& result, const TruthLimits& limits) {
  if (name == "centre") return reason_of_bias(result.centre_from_full, limits.centre_percent, limits);
  if (name == "poured") return reason_of_bias(result.poured_from_full, limits.poured_percent, limits);
  if (name == "spill")
    return fmt::format("{:+.1f} bodies from full, {:.1f} standard errors", result.spill_from_full.difference,
                       std::abs(result.spill_from_full.errors));
  if (name == "awake")
    return fmt::format("of {:.1f} awake {:.1f} were woken by stability checks", result.awake, result.awake_checked);
  if (name == "floating") return "a sleeping body without support";
  return fmt::format("at the end {:.1f} bodies are awake, {:.1f} of all move", result.awake_at_end,
                     result.moving_at_end);
}

/// Runs that tell an estimate and by how much the bodies moved then.
RunValues with_estimate(const RunValues& runs) {
  RunValues estimated = runs;
  std::erase_if(estimated, [](const Values& run) {
    return !std::isfinite(run["estimate_D"]) || !std::isfinite(run["drift_slept_D"]);
  });
  return estimated;
}

}  // namespace

bool is_near(double estimate, double drift) { return estimate >= 0.5 * drift && estimate <= 2.0 * drift; }

EstimateScore estimate_score(std::span<const Values> runs, double tolerance) {
  EstimateScore score;
  for (const Values& run : with_estimate({runs.begin(), runs.end()})) {
    const double estimate = run["estimate_D"];
    const double drift = run["drift_slept_D"];
    ++score.runs;
    score.near += is_near(estimate, drift) ? 1 : 0;
    if (run["estimate_most_D"] > tolerance) continue;
    ++score.claims;
    score.false_claims += drift > tolerance ? 1 : 0;
    score.too_low += drift > 2.0 * estimate ? 1 : 0;
  }
  return score;
}

Bias bias_of(std::span<const double> runs, std::span<const double> baseline) {
  std::vector<double> own(runs.begin(), runs.end());
  std::vector<double> others(baseline.begin(), baseline.end());
  for (std::vector<double>* side : {&own, &others}) {
    std::erase_if(*side, [](double number) { return !std::isfinite(number); });
    if (side->size() < 2) return {};
  }
  Bias bias;
  bias.difference = mean(own) - mean(others);
  bias.percent = bias.difference == 0.0 ? 0.0 : 100.0 * bias.difference / std::abs(mean(others));
  const double error = std::sqrt(variance_of_mean(own) + variance_of_mean(others));
  bias.errors = bias.difference == 0.0 ? 0.0 : bias.difference / error;
  return bias;
}

bool is_beyond(const Bias& bias, double percent, double errors) { return over_limit(bias, percent, errors) > 1.0; }

TruthResult truth_result(const TruthRuns& runs, const TruthLimits& limits) {
  TruthResult result;
  result.centre = bias_over(runs.adaptive, runs.reference, "centre");
  result.centre_from_full = bias_over(runs.adaptive, runs.full, "centre");
  result.poured = bias_over(runs.adaptive, runs.reference, "centre_poured");
  result.r50 = bias_over(runs.adaptive, runs.reference, "r50");
  result.r95 = bias_over(runs.adaptive, runs.reference, "r95");
  result.spill = bias_over(runs.adaptive, runs.reference, "spill");
  result.poured_from_full = bias_over(runs.adaptive, runs.full, "centre_poured");
  result.spill_from_full = bias_over(runs.adaptive, runs.full, "spill");
  result.spill_reference = mean_over(runs.reference, "spill");
  result.drift_full = mean_over(runs.full, "drift_mean_D");
  result.drift = mean_over(runs.adaptive, "drift_mean_D") - result.drift_full;
  result.drift_95 = quantile(numbers_of(runs.adaptive, "drift_mean_D"), 0.95) - result.drift_full;
  const RunValues estimated = with_estimate(runs.adaptive);
  result.estimate = mean_over(estimated, "estimate_D");
  result.drift_slept = mean_over(estimated, "drift_slept_D");
  result.floating = mean_over(runs.adaptive, "floating");
  result.asleep = mean_over(runs.adaptive, "all_asleep");
  result.awake = mean_over(runs.adaptive, "mean_awake");
  result.awake_ratio = mean_over(runs.adaptive, "awake_sampled") / mean_over(runs.adaptive, "moving_sampled");
  result.awake_checked = mean_over(runs.adaptive, "awake_checked");
  result.awake_at_end = mean_over(runs.adaptive, "awake_at_end");
  result.moving_at_end = mean_over(runs.adaptive, "moving_at_end");
  std::vector<double> beyond_moving;
  for (const Values& run : runs.adaptive) beyond_moving.push_back(run["awake_sampled"] - run["moving_sampled"]);
  result.awake_errors = bias_of(beyond_moving, std::vector<double>(2, 0.0)).errors;
  result.speed_up = time_ratio(runs.full, runs.adaptive);
  result.speed_up_reference = time_ratio(runs.reference, runs.adaptive);
  auto over = over_limits(result, runs, limits);
  std::erase_if(over, [](const auto& each) { return std::isnan(each.first); });
  std::ranges::stable_sort(over, [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [ratio, name] : over) {
    result.severity = std::max(result.severity, ratio);
    if (ratio <= 1.0) continue;
    result.beyond.push_back(name);
    result.reasons.push_back(reason_of(name, result, limits));
  }
  return result;
}

}  // namespace talus

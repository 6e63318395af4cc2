// What `talus bench truth` makes of the runs of a cell.

#include "tools/bench/truth_result.h"

#include <gtest/gtest.h>

#include <cmath>

namespace talus::truth_result_test {
namespace {

using Numbers = std::vector<double>;

TEST(TruthBias, PerCentAndStandardErrorsFollowFromMeansAndVariances) {
  // Means 11 and 8; variances 1 and 4, so the squared standard error of the difference is 1/3 + 4/3.
  const Bias bias = bias_of(Numbers{10, 11, 12}, Numbers{6, 8, 10});
  EXPECT_DOUBLE_EQ(bias.difference, 3.0);
  EXPECT_DOUBLE_EQ(bias.percent, 37.5);
  EXPECT_DOUBLE_EQ(bias.errors, 3.0 / std::sqrt(5.0 / 3.0));
}

TEST(TruthBias, EqualRunsHaveNone) {
  const Bias bias = bias_of(Numbers{2, 2}, Numbers{2, 2});
  EXPECT_EQ(bias.percent, 0.0);
  EXPECT_EQ(bias.errors, 0.0);
}

TEST(TruthBias, RunsWithoutScatterThatDifferAreInfinitelyManyErrorsApart) {
  EXPECT_TRUE(std::isinf(bias_of(Numbers{3, 3}, Numbers{2, 2}).errors));
}

TEST(TruthBias, OneRunHasNoScatterToJudgeBy) {
  EXPECT_TRUE(std::isnan(bias_of(Numbers{3}, Numbers{2, 2}).errors));
  EXPECT_TRUE(std::isnan(bias_of(Numbers{3, NAN}, Numbers{2, 2}).percent)) << "what was not measured does not count";
}

Values run_of(double centre, double drift, double seconds) {
  Values values;
  values["centre"] = centre;
  values["drift_mean_D"] = drift;
  values["seconds"] = seconds;
  values["floating"] = 0.0;
  values["all_asleep"] = 1.0;
  values["mean_awake"] = 12.0;
  values["awake_sampled"] = 10.0;
  values["moving_sampled"] = 20.0;
  return values;
}

/// Full and reference alike, adaptive twice as fast.
TruthRuns sound_runs() {
  TruthRuns runs{"cell", "box2d", 2, 0.6, {}, {}, {}};
  for (const double centre : {0.9, 1.0, 1.1, 1.0}) {
    runs.full.push_back(run_of(centre, 0.01, 2.0));
    runs.reference.push_back(run_of(centre, NAN, 10.0));
    runs.adaptive.push_back(run_of(centre, 0.02, 1.0));
  }
  return runs;
}

TEST(TruthResult, ASoundCellIsNotRed) {
  const TruthResult result = truth_result(sound_runs());
  EXPECT_TRUE(result.beyond.empty());
  EXPECT_LE(result.severity, 1.0);
  EXPECT_DOUBLE_EQ(result.drift, 0.01);
  EXPECT_DOUBLE_EQ(result.awake_ratio, 0.5);
  EXPECT_DOUBLE_EQ(result.speed_up.middle, 2.0);
  EXPECT_DOUBLE_EQ(result.speed_up_reference.middle, 10.0);
}

TEST(TruthResult, ASpeedUpIsTheMedianOverTheSeedsWithItsRange) {
  TruthRuns runs = sound_runs();
  runs.adaptive[0]["seconds"] = 2.0;
  runs.adaptive[1]["seconds"] = 0.5;
  const TimeRatio ratio = truth_result(runs).speed_up;
  EXPECT_DOUBLE_EQ(ratio.least, 1.0);
  EXPECT_DOUBLE_EQ(ratio.middle, 2.0);
  EXPECT_DOUBLE_EQ(ratio.most, 4.0);
}

TEST(TruthResult, ARedCellSaysWhetherTheFullRunIsOffByAsMuch) {
  TruthRuns runs = sound_runs();
  for (Values& run : runs.full) run["centre"] = run["centre"] + 0.5;
  for (Values& run : runs.adaptive) run["centre"] = run["centre"] + 0.5;
  EXPECT_EQ(
      truth_result(runs).reasons,
      std::vector<std::string>{"the engine's default step, which full has too: +0.0 % from full, 0.0 standard errors"});
  for (Values& run : runs.full) run["centre"] = run["centre"] - 0.5;
  const TruthResult result = truth_result(runs);
  ASSERT_EQ(result.reasons.size(), 1U);
  EXPECT_EQ(result.reasons[0].substr(0, 19), "the policy: +50.0 %");
}

TEST(TruthEstimate, IsScoredAgainstTheDriftOfTheSleepingBodies) {
  const auto run = [](double estimate, double most, double drift) {
    Values values;
    values["estimate_D"] = estimate;
    values["estimate_most_D"] = most;
    values["drift_slept_D"] = drift;
    return values;
  };
  const std::vector<Values> runs = {run(0.01, 0.02, 0.015), run(0.01, 0.02, 0.03), run(0.04, 0.06, 0.07),
                                    run(0.01, 0.02, 0.06), run(NAN, NAN, 0.2)};
  const EstimateScore score = estimate_score(runs, 0.05);
  EXPECT_EQ(score.runs, 4);
  EXPECT_EQ(score.near, 2);
  EXPECT_EQ(score.claims, 3) << "0.06 D is possible in the third";
  EXPECT_EQ(score.false_claims, 1);
  EXPECT_EQ(score.too_low, 2);
}

TEST(TruthResult, DriftBeyondFullsMakesACellRed) {
  TruthRuns runs = sound_runs();
  for (Values& run : runs.adaptive) run["drift_mean_D"] = 0.09;
  EXPECT_EQ(truth_result(runs).beyond, std::vector<std::string>{"drift"});
  runs.adaptive[0]["drift_mean_D"] = 0.5;
  EXPECT_EQ(truth_result(runs).beyond, (std::vector<std::string>{"drift 95 %", "drift"})) << "the worst first";
}

TEST(TruthResult, ABiasMustBeBothLargeAndResolved) {
  TruthRuns runs = sound_runs();
  for (Values& run : runs.adaptive) run["centre"] = run["centre"] + 0.05;
  EXPECT_TRUE(truth_result(runs).beyond.empty()) << "5 %, but less than two standard errors";
  for (Values& run : runs.adaptive) run["centre"] = run["centre"] + 0.25;
  EXPECT_EQ(truth_result(runs).beyond, std::vector<std::string>{"centre"});
}

TEST(TruthResult, AFloatingBodyAndASleeplessRunMakeACellRed) {
  TruthRuns runs = sound_runs();
  runs.adaptive[1]["floating"] = 1.0;
  EXPECT_EQ(truth_result(runs).beyond, std::vector<std::string>{"floating"});
  runs = sound_runs();
  runs.adaptive[1]["all_asleep"] = 0.0;
  EXPECT_EQ(truth_result(runs).beyond, std::vector<std::string>{"not asleep"});
}

TEST(TruthResult, MoreAwakeThanMovingMakesACellRed) {
  TruthRuns runs = sound_runs();
  for (Values& run : runs.adaptive) run["awake_sampled"] = 30.0;
  EXPECT_EQ(truth_result(runs).beyond, std::vector<std::string>{"awake"});
}

}  // namespace
}  // namespace talus::truth_result_test

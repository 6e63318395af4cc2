#include <fmt/format.h>

#include <cmath>

#include "common/scene/spout_rate.h"
#include "common/scene/typical_body.h"
#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_report.h"
#include "tools/bench/benchmarks.h"

namespace talus {
namespace {

int rate_bodies(const BenchOptions& options) { return options.quick ? 100 : 400; }

/// Half-width of the source that lets bodies leave at this rate [m]; 0 where one point is enough.
template <int Dim>
double needed_spread(const Scene<Dim>& scene, double rate) {
  const double share = rate / reachable_rate(scene.sources.front(), scene.world);
  return share <= 1.0 ? 0.0 : typical_body(scene).extent * std::pow(2.0 * share, 1.0 / (Dim - 1));
}

/// All policies at one pouring rate, from the first body to five seconds after the last.
BenchGroup rate_group(const BenchOptions& options, const std::string& scene, const std::string& backend, double rate) {
  constexpr double after_pour = 5.0;  // [s]
  BenchOptions at_rate = options;
  at_rate.share = 1.0;
  const AnyScene as_given = load({scene, backend, "full", options.settings});
  const double frame_rate = std::visit([](const auto& any) { return any.run.frame_rate; }, as_given);
  const double spread = std::visit([&](const auto& any) { return needed_spread(any, rate); }, as_given);
  at_rate.settings.push_back(fmt::format("source[0].count={}", rate_bodies(options)));
  at_rate.settings.push_back(fmt::format("source[0].rate={}", rate));
  if (spread > 0.0) {
    at_rate.settings.push_back(as_given.index() == 0 ? fmt::format("source[0].spread=[{:.2f},0.0]", spread)
                                                     : fmt::format("source[0].spread=[{0:.2f},{0:.2f},0.0]", spread));
  }
  at_rate.settings.push_back(
      fmt::format("run.frames={}", std::llround(std::ceil((rate_bodies(options) / rate + after_pour) * frame_rate))));
  return policies_group(at_rate, scene, backend);
}

std::vector<BenchGroup> rate_groups(const BenchOptions& options, const std::string& scene, const std::string& backend) {
  std::vector<BenchGroup> groups;
  const std::vector<double> rates =
      options.quick ? std::vector<double>{2.0, 6.6, 20.0} : std::vector<double>{1.0, 2.0, 6.6, 15.0, 30.0, 60.0};
  for (const double rate : rates) groups.push_back(rate_group(options, scene, backend, rate));
  return groups;
}

}  // namespace

void bench_rate(const BenchOptions& options) {
  std::vector<CaseColumn> columns = name_columns();
  for (const CaseColumn& column : {plain("reached_rate"), with_range("speed_up"), plain("speed_up_pour"),
                                   hindsight_column(), plain("drift_mean_excess_D"), plain("ks_z_p")}) {
    columns.push_back(column);
  }
  run_report(
      {.title = "Speed-up over the pouring rate",
       .note = "Example 1 poured at several rates, from the first body to five seconds after the last. The slower "
               "the pour, the more there is to save.",
       .scenes = {"drop_in_a_pile"},
       .groups = rate_groups,
       .columns = columns,
       .in_table = sleeps,
       .plots = {{.caption = "Speed-up over the rate that the source reached.",
                  .x_label = "bodies per second",
                  .x = measured("reached_rate"),
                  .y = "speed_up",
                  .log_x = true,
                  .log_y = true,
                  .bars = Bars::rounds,
                  .curve = sleeping_policy_of}}},
      options);
}

}  // namespace talus

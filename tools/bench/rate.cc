#include <fmt/format.h>

#include <cmath>

#include "common/scene/spout_rate.h"
#include "common/scene/typical_body.h"
#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_results.h"
#include "tools/bench/benchmarks.h"
#include "tools/plot/plot.h"

namespace talus {

namespace {

std::vector<double> rates(const BenchOptions& options) {
  return options.quick ? std::vector<double>{2.0, 6.6, 20.0} : std::vector<double>{1.0, 2.0, 6.6, 15.0, 30.0, 60.0};
}

int bodies(const BenchOptions& options) { return options.quick ? 100 : 400; }

/// Room to each side on each horizontal axis that bodies need to leave at this rate [m]; 0 where one spot will do.
template <int Dim>
double needed_spread(const Scene<Dim>& scene, double rate) {
  const double share = rate / reachable_rate(scene.sources.front(), scene.world);
  return share <= 1.0 ? 0.0 : typical_body(scene).extent * std::pow(2.0 * share, 1.0 / (Dim - 1));
}

/// All policies at one pouring rate, from the first body to five seconds after the last.
BenchGroup group_of(const BenchOptions& options, const std::string& scene, const std::string& backend, double rate) {
  constexpr double calm = 5.0;  // [s]
  BenchOptions at_rate = options;
  at_rate.share = 1.0;
  const AnyScene as_is = load({scene, backend, "full", options.settings});
  const double frame_rate = std::visit([](const auto& any) { return any.run.frame_rate; }, as_is);
  const double spread = std::visit([&](const auto& any) { return needed_spread(any, rate); }, as_is);
  at_rate.settings.push_back(fmt::format("source[0].count={}", bodies(options)));
  at_rate.settings.push_back(fmt::format("source[0].rate={}", rate));
  if (spread > 0.0) {
    at_rate.settings.push_back(as_is.index() == 0 ? fmt::format("source[0].spread=[{:.2f},0.0]", spread)
                                                  : fmt::format("source[0].spread=[{0:.2f},{0:.2f},0.0]", spread));
  }
  at_rate.settings.push_back(
      fmt::format("run.frames={}", std::llround(std::ceil((bodies(options) / rate + calm) * frame_rate))));
  return policies_group(at_rate, scene, backend);
}

/// Bodies a second that came in fact, from the first to the last.
double reached_rate(const BenchRunner& runner, const BenchGroup& group) {
  const Values values = runner.summary(group.cases.front(), group.cases.front());
  return value_of(values, "bodies") / value_of(values, "poured_at");
}

struct RateSweep {
  std::string scene;
  std::string backend;
  std::vector<BenchGroup> groups;  // one a rate
};

Table table_of(const BenchRunner& runner, const std::vector<RateSweep>& sweeps) {
  Table table{"",
              {{"scene"},
               {"engine"},
               {"policy"},
               {"bodies a second", true},
               {"speed-up", true},
               {"while pouring", true},
               {"oracle's ceiling", true},
               {"drift beyond full / D", true},
               {"KS(z) p", true}},
              {}};
  for (const RateSweep& sweep : sweeps) {
    for (const BenchGroup& group : sweep.groups) {
      const Values of_full = runner.summary(group.cases.front(), group.cases.front());
      for (const BenchCase& each : group.cases) {
        if (each.policy == "full" || each.policy == reference_policy) continue;
        const Values values = runner.summary(each, group.cases.front());
        table.rows.push_back({key_of(each).scene, each.backend, each.policy, shown(reached_rate(runner, group)),
                              shown_with_range(values, "speed_up"), shown(value_of(values, "speed_up_pour")),
                              shown(value_of(of_full, "oracle_005")), shown(value_of(values, "drift_mean_excess_D")),
                              shown(value_of(values, "ks_z_p"), 2)});
      }
    }
  }
  return table;
}

Plot plot_of(const BenchRunner& runner, const RateSweep& sweep) {
  Plot plot{.title = sweep.scene + ", " + sweep.backend,
            .x_label = "bodies a second",
            .y_label = "speed-up over full",
            .log_x = true,
            .log_y = true,
            .series = {}};
  const auto add = [&](const std::string& name, std::size_t index, const std::string& value) {
    Series series{name, {}, {}};
    series.style = SeriesStyle::line_and_points;
    for (const BenchGroup& group : sweep.groups) {
      const double speed_up = value_of(runner.summary(group.cases[index], group.cases.front()), value);
      if (!std::isfinite(speed_up) || speed_up <= 0.0) continue;
      series.x.push_back(reached_rate(runner, group));
      series.y.push_back(speed_up);
    }
    if (!series.x.empty()) plot.series.push_back(series);
  };
  const std::vector<BenchCase>& cases = sweep.groups.front().cases;
  for (std::size_t i = 1; i < cases.size(); ++i) {
    if (cases[i].policy != reference_policy) add(cases[i].policy, i, "speed_up");
  }
  add("oracle's ceiling", 0, "oracle_005");
  return plot;
}

}  // namespace

void bench_rate(const BenchOptions& options) {
  std::vector<RateSweep> sweeps;
  std::vector<BenchGroup> groups;
  for (const std::string& scene : scenes_of(options, {"drop_in_a_pile"}, 1)) {
    for (const std::string& backend : backends_of(options, scene)) {
      RateSweep sweep{scene, backend, {}};
      for (const double rate : rates(options)) sweep.groups.push_back(group_of(options, scene, backend, rate));
      groups.insert(groups.end(), sweep.groups.begin(), sweep.groups.end());
      sweeps.push_back(std::move(sweep));
    }
  }
  BenchRunner runner(options);
  runner.run(groups);
  BenchResults results{"Speed-up over the pouring rate", {}, {}};
  results.notes.push_back(
      fmt::format("Example 1 with {} bodies poured at each rate, from the first body to five seconds after the last: "
                  "the calmer the "
                  "pour, the more there is to save.",
                  bodies(options)));
  results.sections.push_back({"Speed-up", {table_of(runner, sweeps)}});
  for (const RateSweep& sweep : sweeps) {
    results.sections.back().blocks.emplace_back(Figure{svg_of(plot_of(runner, sweep)), sweep.scene});
  }
  for (Section& section : common_sections(runner, groups)) results.sections.push_back(std::move(section));
  write_results(runner, groups, results);
  fmt::print("{}", text_of(table_of(runner, sweeps)));
}

}  // namespace talus

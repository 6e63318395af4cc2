#include <fmt/format.h>

#include <algorithm>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_results.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/sleepers_cost.h"
#include "tools/bench/waking_shock.h"
#include "tools/output/output.h"
#include "tools/plot/plot.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

constexpr int awake_bodies = 100;

SleepersCost cost_on(const std::string& backend, int dimension, int sleepers) {
  print_message("{}: {} sleepers", backend, sleepers);
  return dimension == 2 ? sleepers_cost<2>(backend, sleepers, awake_bodies)
                        : sleepers_cost<3>(backend, sleepers, awake_bodies);
}

struct Engine {
  std::string backend;
  int dimension;
  std::vector<SleepersCost> costs;  // by number of sleepers
};

std::vector<Engine> measured(const BenchOptions& options) {
  const std::vector<int> sizes =
      options.quick ? std::vector<int>{1000, 10000} : std::vector<int>{1000, 10000, 100000, 1000000};
  std::vector<Engine> engines;
  for (const int dimension : {2, 3}) {
    for (const std::string& backend : backends(dimension)) {
      const auto& wanted = options.backends;
      if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), backend) == wanted.end()) continue;
      Engine engine{backend, dimension, {}};
      for (const int sleepers : sizes) engine.costs.push_back(cost_on(backend, dimension, sleepers));
      engines.push_back(engine);
    }
  }
  return engines;
}

Table cost_table(const std::vector<Engine>& engines) {
  Table table{"",
              {{"engine"},
               {"sleepers", true},
               {"step with 100 awake [ms]", true},
               {"over 1,000 sleepers", true},
               {"step with none awake [µs]", true},
               {"freeze and thaw [µs a body]", true},
               {"memory [bytes a sleeper]", true},
               {"of L shapes", true}},
              {}};
  for (const Engine& engine : engines) {
    for (const SleepersCost& cost : engine.costs) {
      table.rows.push_back({engine.backend, std::to_string(cost.sleepers), shown(cost.step_ms),
                            shown(cost.step_ms / engine.costs.front().step_ms), shown(cost.idle_step_us),
                            shown(cost.freeze_thaw_us), shown(cost.bytes, 4), shown(cost.bytes_of_l, 4)});
    }
  }
  return table;
}

Plot cost_plot(const std::vector<Engine>& engines) {
  Plot plot{.title = "", .x_label = "sleepers", .y_label = "step with 100 awake [ms]", .log_x = true, .series = {}};
  for (const Engine& engine : engines) {
    Series series{engine.backend, {}, {}};
    series.style = SeriesStyle::line_and_points;
    for (const SleepersCost& cost : engine.costs) {
      series.x.push_back(cost.sleepers);
      series.y.push_back(cost.step_ms);
    }
    plot.series.push_back(series);
  }
  return plot;
}

Table waking_table(const BenchOptions& options) {
  Table table{"",
              {{"scene"},
               {"engine"},
               {"peak mean speed [m/s]", true},
               {"never frozen", true},
               {"ratio", true},
               {"drift in 2 s [m]", true},
               {"never frozen", true},
               {"ratio", true}},
              {}};
  for (const std::string& scene : scenes_of(options, {"drop_in_a_pile"}, 1)) {
    for (const std::string& backend :
         options.backends.empty() ? backends(dimension_of(scene)) : backends_of(options, scene)) {
      print_message("waking: {} {}", scene, backend);
      const int bodies = options.quick ? 50 : 200;
      const BenchCase pile{scene,
                           backend,
                           "full",
                           {fmt::format("source[0].count={}", bodies), fmt::format("run.frames={}", bodies * 5 + 300)}};
      const WakingShock shock = std::visit([&](const auto& any) { return waking_shock(any, backend); }, load(pile));
      table.rows.push_back({key_of(pile).scene, backend, shown(shock.speed), shown(shock.speed_never),
                            shown(shock.speed / shock.speed_never), shown(shock.drift), shown(shock.drift_never),
                            shown(shock.drift / shock.drift_never)});
    }
  }
  return table;
}

}  // namespace

void bench_scale(const BenchOptions& options) {
  const std::vector<Engine> engines = measured(options);
  const Table waking = waking_table(options);
  const BenchRunner runner(options);
  BenchResults results{"What sleepers cost", {}, {}};
  results.notes.emplace_back(
      "A block of boxes asleep, 100 awake at rest on its top, on the bare engine: medians of 200 steps. Memory is all "
      "that the process took on, over the sleepers. Waking: a pour at rest, frozen for a second and woken, beside the "
      "same pile never frozen; the two should agree.");
  results.sections.push_back(
      {"Steps", {cost_table(engines), Figure{svg_of(cost_plot(engines)), "A step should cost what moves."}}});
  results.sections.push_back({"Waking", {waking}});
  write_results(runner, {}, results);
  print_result("{}\n{}", text_of(cost_table(engines)), text_of(waking));
}

}  // namespace talus

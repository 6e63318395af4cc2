
#include <algorithm>
#include <iterator>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_results.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/coming_to_rest.h"
#include "tools/output/output.h"

namespace talus {
namespace {

/// Of one scene on one engine: the engine's own sleeping first, then the others beside it.
void add_rows(const BenchOptions& options, const std::string& scene, const std::string& backend, Table& table) {
  const double calm = options.quick ? 5.0 : 25.0;  // [s]; Bullet alone takes 20 to fall asleep
  std::vector<std::string> policies = {"engine"};
  std::ranges::copy(policies_of(options), std::back_inserter(policies));
  ComingToRest engine;
  for (const std::string& policy : policies) {
    print_message("{} {} {}", scene, backend, policy);
    const BenchCase each{scene, backend, policy, settings_of(options, scene)};
    const ComingToRest rest =
        std::visit([&](const auto& any) { return coming_to_rest(any, backend, calm); }, load(each));
    if (policy == "engine") engine = rest;
    const double at_stop = rest.step_time(rest.stopped);
    const double later = rest.step_time(rest.stopped + 1.0);
    const double engine_at_stop = engine.step_time(rest.stopped);
    const double engine_later = engine.step_time(rest.stopped + 1.0);
    table.rows.push_back({key_of(each).scene, backend, std::to_string(rest.bodies), policy, shown(rest.stopped),
                          shown(rest.asleep), shown(rest.asleep - rest.stopped), shown(1e6 * at_stop),
                          shown(engine_at_stop / at_stop), shown(1e6 * later), shown(engine_later / later)});
  }
}

}  // namespace

void bench_rest(const BenchOptions& options) {
  Table table{"",
              {{"scene"},
               {"engine"},
               {"bodies", true},
               {"policy"},
               {"last body stops [s]", true},
               {"all asleep [s]", true},
               {"that is later by [s]", true},
               {"step in the second from the stop on [µs]", true},
               {"engine's over it", true},
               {"step in the second after [µs]", true},
               {"engine's over it", true}},
              {}};
  const std::vector<std::string> names = {"drop_in_a_pile", "drop_in_a_line", "multiple_piles", "rings_in_a_box"};
  for (const std::string& scene : scenes_of(options, names, 1))
    for (const std::string& backend : backends_of(options, scene)) add_rows(options, scene, backend, table);
  const BenchRunner runner(options);
  BenchResults results{"Coming to rest", {}, {}};
  results.notes.emplace_back(
      "Each scene poured to its last body, then watched. Times count from when that was dropped. A body has stopped "
      "when its centre is within 0.01 D of where it ends; steps in processor time. The engine's step is that of its "
      "own sleeping at the same simulated time.");
  results.sections.push_back({"Coming to rest", {table}});
  write_results(runner, {}, results);
  print_text(text_of(table));
}

}  // namespace talus

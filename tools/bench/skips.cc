#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_results.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/measure.h"
#include "tools/output/output.h"

namespace talus {
namespace {

/// Without debug options, then with each in turn.
BenchGroup skips_group(const BenchCase& plain) {
  BenchGroup group{{plain}};
  for (const Field<DebugOptions>& field : debug_fields) {
    group.cases.push_back(plain);
    group.cases.back().settings.push_back(fmt::format("debug.{}=true", field.key.name));
  }
  return group;
}

std::vector<BenchGroup> plan(const BenchOptions& options) {
  const std::vector<std::string> names = {"drop_in_a_pile", "drop_in_a_line", "multiple_piles", "rings_in_a_box"};
  const std::vector<std::string> policies =
      options.policies.empty() ? std::vector<std::string>{"adaptive"} : options.policies;
  std::vector<BenchGroup> groups;
  for (const std::string& scene : scenes_of(options, names, 1)) {
    for (const std::string& backend : backends_of(options, scene))
      for (const std::string& policy : policies)
        groups.push_back(skips_group({scene, backend, policy, settings_of(options, scene)}));
  }
  return groups;
}

bool same_bits(const BenchRunner& runner, const BenchGroup& group, const BenchCase& each) {
  return runner.hashes(each) == runner.hashes(group.cases.front());
}

/// Times everything; then, where an option changed the bits, by how much.
void measure(const std::vector<BenchGroup>& groups, const BenchOptions& options) {
  BenchOptions times_only = options;
  times_only.errors = false;
  std::vector<BenchGroup> changed;
  {
    BenchRunner runner(times_only);
    runner.run(groups);
    for (const BenchGroup& group : groups) {
      BenchGroup other{{group.cases.front()}};
      std::copy_if(group.cases.begin() + 1, group.cases.end(), std::back_inserter(other.cases),
                   [&](const BenchCase& each) { return !same_bits(runner, group, each); });
      if (other.cases.size() > 1) changed.push_back(other);
    }
  }
  if (options.errors) BenchRunner(options).run(changed);
}

/// Fastest round with the option over the fastest without.
std::string ratio_of(const Values& with, const Values& without) {
  return shown(with["seconds_min"] / without["seconds_min"]);
}

std::vector<std::string> row_of(const BenchRunner& runner, const BenchGroup& group, const BenchCase& each) {
  const BenchCase& first = group.cases.front();
  const Values values = runner.summary(each, first);
  const bool same = same_bits(runner, group, each);
  const auto error = [&](MeasureId id) { return same ? "0" : shown_with_floor(values, id); };
  return {key_of(each).scene,
          each.backend,
          each.policy,
          key_of(each) == key_of(first) ? "none" : each.settings.back(),
          shown_with_range(values, "seconds"),
          ratio_of(values, runner.summary(first, first)),
          shown(values, "mean_awake"),
          same ? "yes" : "no",
          error("horizon_R_30"),
          error("profile_rms_D"),
          error("ks_r")};
}

Table skips_table(const BenchRunner& runner, const std::vector<BenchGroup>& groups) {
  Table table{"", {{"scene"}, {"engine"}, {"policy"}, {"option"}}, {}};
  for (const char* name : {"time [s]", "over none", "mean awake", "same bits", "R after 30 frames / floor",
                           "profile rms / D, floor", "KS(r) / floor"}) {
    table.columns.push_back({name, true});
  }
  for (const BenchGroup& group : groups)
    for (const BenchCase& each : group.cases) table.rows.push_back(row_of(runner, group, each));
  return table;
}

}  // namespace

void bench_skips(const BenchOptions& options) {
  const std::vector<BenchGroup> groups = plan(options);
  measure(groups, options);
  const BenchRunner runner(options);
  BenchResults results{"What a step leaves out", {}, {}};
  results.notes.push_back(
      "Each run again with one debug option (`[debug]` in a scene, `--set debug.step_when_idle=true`), which puts back "
      "work that a step leaves out. Over none: the fastest round with the option over the fastest without, since the "
      "differences are small and another process only ever adds time. In 2D `collide_in_flight` has no effect, so its "
      "row shows the noise. Where an option changes the bits, the two runs are compared; the floor is what a "
      "micrometre does to the run without options.");
  results.sections.push_back({"What each option costs", {skips_table(runner, groups)}});
  write_results(runner, groups, results);
  print_text(text_of(skips_table(runner, groups)));
}

}  // namespace talus

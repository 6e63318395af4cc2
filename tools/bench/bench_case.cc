#include "tools/bench/bench_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "common/measure/rebuild.h"
#include "tools/bench/paper_figures.h"
#include "tools/run/find_scene.h"
#include "tools/run/version.h"

namespace talus {

bool is_baseline(const BenchCase& bench_case) {
  return bench_case.policy == reference_policy || bench_case.policy == engine_default_policy;
}

RowKey key_of(const BenchCase& bench_case) {
  return {.scene = find_scene(bench_case.scene).stem().string(),
          .backend = bench_case.backend,
          .policy = bench_case.policy,
          .settings = fmt::format("{}", fmt::join(bench_case.settings, " ")),
          .version = version_text()};
}

namespace {

/// The frames of the paper's run, where the scene is the name of one of its examples or of example 1 with other shapes.
std::vector<Override> frames_of_paper(const std::string& scene) {
  const std::filesystem::path file = find_scene(scene);
  if (file == scene) return {};
  const std::string name = file.stem().string();
  for (const paper::Example& example : paper::table_1)
    if (name.starts_with(example.scene) || (name.starts_with("several_sizes") && example.number == "1"))
      return {{fmt::format("run.frames={}", example.frames)}};
  return {};
}

}  // namespace

AnyScene load(const BenchCase& bench_case) {
  const bool reference = bench_case.policy == reference_policy;
  const bool engine_default = bench_case.policy == engine_default_policy;
  const std::string policy = reference ? "full" : engine_default ? "engine" : bench_case.policy;
  std::vector<Override> overrides = frames_of_paper(bench_case.scene);
  for (const std::string& setting : bench_case.settings) overrides.push_back({setting});
  overrides.push_back({"policy.kind=" + policy});
  AnyScene scene = read_scene(find_scene(bench_case.scene), overrides);
  if (reference) std::visit([](auto& any) { any.world = reference_settings(any.world); }, scene);
  if (engine_default) std::visit([](auto& any) { any.world = engine_default_settings(any.world); }, scene);
  return scene;
}

int dimension_of(const std::string& scene) {
  return std::visit([]<int Dim>(const Scene<Dim>&) { return Dim; }, read_scene(find_scene(scene)));
}

const BenchCase* BenchGroup::find(const std::string& policy) const {
  const auto found = std::ranges::find(cases, policy, &BenchCase::policy);
  return found == cases.end() ? nullptr : &*found;
}

}  // namespace talus

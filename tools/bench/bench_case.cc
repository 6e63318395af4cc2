#include "tools/bench/bench_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/measure/rebuild.h"
#include "common/policy/sleep_policy.h"
#include "tools/run/find_scene.h"
#include "tools/run/version.h"

namespace talus {

RowKey key_of(const BenchCase& bench_case) {
  return {find_scene(bench_case.scene).stem().string(),
          bench_case.backend,
          bench_case.policy,
          fmt::format("{}", fmt::join(bench_case.settings, " ")),
          "",
          version_text()};
}

bool is_yardstick(const BenchCase& bench_case) {
  return bench_case.policy == reference_policy || bench_case.policy == shipped_policy;
}

AnyScene load(const BenchCase& bench_case) {
  const bool reference = bench_case.policy == reference_policy;
  const bool shipped = bench_case.policy == shipped_policy;
  const std::string policy = reference ? "full" : shipped ? "engine" : bench_case.policy;
  std::vector<Override> overrides;
  for (const std::string& setting : bench_case.settings) overrides.push_back({setting});
  overrides.push_back({"policy.kind=" + policy});
  AnyScene scene = read_scene(find_scene(bench_case.scene), overrides);
  if (reference) std::visit([](auto& any) { any.world = reference_settings(any.world); }, scene);
  if (shipped) std::visit([](auto& any) { any.world = shipped_settings(any.world); }, scene);
  return scene;
}

int dimension_of(const std::string& scene) {
  return std::visit([]<int Dim>(const Scene<Dim>&) { return Dim; }, read_scene(find_scene(scene)));
}

std::vector<std::string> known_policies() {
  std::vector<std::string> known;
  for (const char* name : {"paper", "adaptive"}) {
    Scene<2> scene;
    scene.policy.kind = name;
    try {
      make_policy(scene);
      known.emplace_back(name);
    } catch (const std::invalid_argument&) {
      continue;  // not in this build
    }
  }
  return known;
}

}  // namespace talus

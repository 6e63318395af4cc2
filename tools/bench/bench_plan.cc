#include "tools/bench/bench_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tools/run/backends.h"
#include "tools/run/find_scene.h"

namespace talus {
namespace {

/// The scenes that a name stands for.
std::vector<std::string> scenes_named(const std::string& name) {
  std::vector<std::string> found;
  if (std::filesystem::is_regular_file(name)) return {name};
  for (const std::filesystem::path& file : scene_files()) {
    const std::string stem = file.stem().string();
    if (stem == name || stem == name + "_2d" || stem == name + "_3d") found.push_back(stem);
  }
  return found;
}

}  // namespace

std::vector<std::string> scenes_of(const BenchOptions& options, const std::vector<std::string>& names,
                                   std::size_t quick_count) {
  std::vector<std::string> scenes;
  for (const std::string& name : options.scenes) {
    const std::vector<std::string> found = scenes_named(name);
    if (found.empty()) find_scene(name);  // throws with the nearest name
    scenes.insert(scenes.end(), found.begin(), found.end());
  }
  if (!options.scenes.empty()) return scenes;
  const std::size_t count = options.quick ? std::min(quick_count, names.size()) : names.size();
  for (std::size_t i = 0; i < count; ++i)
    for (const std::string& scene : scenes_named(names[i])) scenes.push_back(scene);
  return scenes;
}

std::vector<std::string> backends_of(const BenchOptions& options, const std::string& scene) {
  const std::vector<std::string> able = backends(dimension_of(scene));
  if (able.empty()) return {};
  if (options.backends.empty()) return {able.front()};
  std::vector<std::string> wanted;
  for (const std::string& backend : able)
    if (std::find(options.backends.begin(), options.backends.end(), backend) != options.backends.end())
      wanted.push_back(backend);
  return wanted;
}

std::vector<std::string> settings_of(const BenchOptions& options, const std::string& scene) {
  std::vector<std::string> settings = options.settings;
  if (options.share == 1.0) return settings;
  const std::int64_t frames =
      std::visit([](const auto& any) { return any.run.frames; }, load({scene, "", "full", options.settings}));
  const double shorter = std::ceil(static_cast<double>(frames) * options.share);
  settings.push_back(fmt::format("run.frames={}", std::llround(shorter)));
  return settings;
}

std::vector<std::string> policies_of(const BenchOptions& options) {
  std::vector<std::string> policies = options.policies;
  if (policies.empty()) policies = {"paper", "adaptive"};
  std::erase_if(policies, [](const std::string& policy) { return policy == "full" || policy == "engine"; });
  return policies;
}

BenchGroup policies_group(const BenchOptions& options, const std::string& scene, const std::string& backend) {
  const std::vector<std::string> settings = settings_of(options, scene);
  BenchGroup group;
  for (const char* policy : {"full", "engine"}) group.cases.push_back({scene, backend, policy, settings});
  for (const std::string& policy : policies_of(options)) group.cases.push_back({scene, backend, policy, settings});
  if (options.reference) group.cases.push_back({scene, backend, reference_policy, settings});
  return group;
}

}  // namespace talus

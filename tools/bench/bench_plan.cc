#include "tools/bench/bench_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "tools/bench/paper_figures.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"
#include "tools/run/make_simulation.h"
#include "tools/sweep/sweep_plan.h"

namespace talus {
namespace {

constexpr auto presets = std::to_array<BenchPreset>({
    {"table1", "Table 1: examples 1 to 6"},
    {"table2", "Table 2: example 2 over the sleeping threshold tau"},
    {"figure5", "Figure 5: time and error per frame in example 5"},
    {"figure6", "Figure 6: time and error per frame in example 6"},
});

/// The paper's example of a scene of ours, without its dimension.
const paper::Example* example_of(std::string_view scene) {
  const auto found = std::ranges::find_if(paper::table_1, [&](const paper::Example& example) {
    return scene == std::string(example.scene) + "_2d" || scene == std::string(example.scene) + "_3d";
  });
  return found == paper::table_1.end() ? nullptr : &*found;
}

/// The preset's scenes in both dimensions.
std::vector<std::string> scenes_of(std::string_view preset, bool quick) {
  const std::string_view number = preset == "table2" ? "2" : preset == "figure5" ? "5" : "6";
  std::vector<std::string> scenes;
  for (const paper::Example& example : paper::table_1) {
    const bool slow = example.number.starts_with("4") || example.number == "6";
    if (preset == "table1" ? quick && slow : example.number != number) continue;
    for (const char* dimension : {"_2d", "_3d"}) scenes.push_back(std::string(example.scene) + dimension);
  }
  return scenes;
}

std::vector<std::string> policies_of(std::string_view preset) {
  if (preset == "table2") return {"full", "paper"};
  if (!preset.empty()) return {"full", "engine", "paper", "adaptive"};
  return {"full", "paper", "adaptive", std::string(reference_policy)};
}

bool sets(const std::vector<SweepAxis>& axes, const std::string& path) {
  return std::ranges::any_of(axes, [&](const SweepAxis& axis) { return overlap(axis.path, path); });
}

std::vector<SweepAxis> axes_of(const BenchOptions& options) {
  std::vector<SweepAxis> axes;
  for (const std::string& setting : options.settings) {
    axes.push_back(sweep_axis(setting));
    const std::string& path = axes.back().path;
    if (overlap(path, "seed")) throw std::invalid_argument(fmt::format("--set {}: must be given by --seeds", path));
    if (overlap(path, "policy.kind"))
      throw std::invalid_argument(fmt::format("--set {}: must leave policy.kind to --policy", path));
  }
  require_apart(axes);
  if (options.preset == "table2" && !sets(axes, "policy.tau")) {
    axes.push_back({"policy.tau", {}});
    for (const paper::Threshold& threshold : paper::table_2)
      axes.back().values.push_back(fmt::format("{}", threshold.tau));
  }
  return axes;
}

/// The frames that the preset and --quick leave of a scene, as a setting; empty: all of its own.
std::vector<std::string> frames_of(const BenchOptions& options, const std::filesystem::path& scene) {
  const paper::Example* example = options.preset.empty() ? nullptr : example_of(scene.stem().string());
  if (example == nullptr && !options.quick) return {};
  const std::int64_t frames = example != nullptr
                                  ? example->frames
                                  : std::visit([](const auto& each) { return each.run.frames; }, read_scene(scene));
  return {fmt::format("run.frames={}", options.quick ? (frames + 1) / 2 : frames)};
}

/// The engines for a scene.
std::vector<std::string> engines_of(const BenchOptions& options, const std::filesystem::path& scene) {
  const int dimension = std::visit([]<int Dim>(const Scene<Dim>&) { return Dim; }, read_scene(scene));
  std::vector<std::string> engines = backends(dimension);
  if (options.backends.empty()) {
    engines.resize(std::min<std::size_t>(1, engines.size()));
  } else {
    std::erase_if(engines, [&](const std::string& engine) {
      return std::ranges::find(options.backends, engine) == options.backends.end();
    });
  }
  return engines;
}

std::vector<std::vector<std::string>> settings_of(const BenchOptions& options, const std::filesystem::path& scene) {
  const std::vector<SweepAxis> axes = axes_of(options);
  std::vector<std::vector<std::string>> all;
  for (int i = 0; i < sweep_size(axes); ++i) {
    std::vector<std::string> settings;
    if (!sets(axes, "run.frames")) settings = frames_of(options, scene);
    std::ranges::copy(settings_of(axes, sweep_run(axes, i)), std::back_inserter(settings));
    all.push_back(std::move(settings));
  }
  return all;
}

/// The cases of a scene on an engine at one seed.
std::vector<BenchCase> cases_at_seed(const BenchOptions& options, const std::filesystem::path& scene,
                                     const std::string& engine, int seed) {
  std::vector<BenchCase> cases;
  for (const std::vector<std::string>& settings : settings_of(options, scene)) {
    for (const std::string& policy : options.policies) {
      BenchCase each{scene, engine, policy, settings, seed};
      if (each.is_baseline()) each.settings = settings_of_world(settings);
      const bool known = std::ranges::any_of(
          cases, [&](const BenchCase& other) { return other.policy == policy && other.settings == each.settings; });
      if (!known) cases.push_back(std::move(each));
    }
  }
  return cases;
}

/// What is wrong with a case shows before the first run.
void check_case(const BenchCase& bench_case, const BenchOptions& options) {
  const AnyScene read = load(bench_case);
  std::visit([&](const auto& scene) { check_window(scene, bench_case.backend, bench_case.scene, options.force); },
             read);
}

}  // namespace

std::span<const BenchPreset> bench_presets() { return presets; }

BenchOptions completed(BenchOptions options) {
  if (options.scenes.empty() && options.preset.empty())
    throw std::invalid_argument("bench: must have a scene or --preset; see --help");
  if (options.scenes.empty()) options.scenes = scenes_of(options.preset, options.quick);
  if (options.policies.empty()) options.policies = policies_of(options.preset);
  if (options.seeds == 0) options.seeds = options.quick ? 2 : 3;
  options.extras.frames = options.preset.starts_with("figure");
  options.extras.motion_error = options.extras.motion_error || options.extras.frames || options.preset == "table1";
  return options;
}

std::vector<std::filesystem::path> files_of(const BenchOptions& options) {
  std::vector<std::filesystem::path> files;
  for (const std::string& scene : options.scenes) {
    files.push_back(std::filesystem::absolute(find_scene(scene)));
    const auto same_name = [&](const auto& file) { return file.stem() == files.back().stem(); };
    if (std::ranges::count_if(files, same_name) > 1)
      throw std::invalid_argument(fmt::format("SCENE = {}: must be the only one of this name", scene));
  }
  return files;
}

std::vector<BenchCase> bench_cases(const BenchOptions& options) {
  std::vector<BenchCase> cases;
  const std::vector<std::filesystem::path> files = files_of(options);
  for (int seed = 1; seed <= options.seeds; ++seed) {
    for (const std::filesystem::path& file : files) {
      for (const std::string& engine : engines_of(options, file)) {
        for (BenchCase& each : cases_at_seed(options, file, engine, seed)) {
          if (seed == 1) check_case(each, options);
          cases.push_back(std::move(each));
          if (cases.size() > most_sweep_runs)
            throw std::invalid_argument(fmt::format("bench: must have at most {} runs", most_sweep_runs));
        }
      }
    }
  }
  if (cases.empty())
    throw std::invalid_argument(fmt::format("--backend = {}: must be an engine on which one of the scenes runs",
                                            fmt::join(options.backends, ",")));
  return cases;
}

std::vector<FileHashes> hashes_of(const BenchOptions& options, const std::vector<BenchCase>& cases) {
  std::vector<FileHashes> hashes;
  for (const std::string& scene : options.scenes) {
    hashes.emplace_back();
    for (const BenchCase& each : cases)
      if (each.scene == scene && each.seed == 1) add_file_hashes(hashes.back(), scene, load(each));
  }
  return hashes;
}

std::vector<BenchRound> rounds_of(const std::vector<BenchCase>& cases) {
  std::vector<BenchRound> rounds;
  for (int i = 0; i < std::ssize(cases); ++i) {
    const BenchCase& last = cases[std::max(0, i - 1)];
    const bool same = cases[i].scene == last.scene && cases[i].backend == last.backend && cases[i].seed == last.seed;
    if (i == 0 || !same) rounds.push_back({i, 0});
    ++rounds.back().count;
  }
  return rounds;
}

std::optional<PapersNumbers> papers_numbers(const BenchCase& bench_case, std::string_view preset) {
  const paper::Example* example = example_of(bench_case.scene_name());
  if (bench_case.policy != "paper" || example == nullptr) return std::nullopt;
  if (preset != "table2") return PapersNumbers{example->speed_up, example->error};
  if (example->number != "2") return std::nullopt;
  for (const paper::Threshold& threshold : paper::table_2)
    if (std::ranges::find(bench_case.settings, fmt::format("policy.tau={}", threshold.tau)) !=
        bench_case.settings.end())
      return PapersNumbers{threshold.speed_up, BenchNumbers::none};
  return std::nullopt;
}

}  // namespace talus

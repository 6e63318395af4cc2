#include "tools/bench/truth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>

#include "common/simulation/stopwatch.h"
#include "tools/bench/bench_case.h"
#include "tools/bench/in_processes.h"
#include "tools/bench/recording.h"
#include "tools/bench/truth_report.h"
#include "tools/bench/truth_run.h"
#include "tools/output/output.h"
#include "tools/picture/picture.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// The policies of a cell, in the order in which they run.
constexpr std::array truth_policies = {"full", reference_policy, "adaptive"};

/// A cell on one engine.
struct TruthTask {
  TruthCell cell;
  std::string backend;
  fs::path scene;        // file
  std::string identity;  // of the scene's text
};

/// One seed of it: a process of its own runs what is missing.
struct TruthUnit {
  const TruthTask& task;
  int seed = 1;
};

std::string contents_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// FNV-1a.
std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char byte : text) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  return hash;
}

/// The running program, whether committed or not.
std::string program_identity() {
  static const std::string identity = fmt::format("program {:016x}", hash_of(contents_of("/proc/self/exe")));
  return identity;
}

TruthOptions completed_truth(TruthOptions options) {
  if (options.count == 0) options.count = options.design == 1 ? 60 : 20;
  if (options.seeds == 0) options.seeds = options.quick ? 4 : 16;
  if (options.bodies == 0) options.bodies = options.quick ? 60 : 200;
  if (options.out.empty()) options.out = fs::path("bench") / (options.quick ? "truth-quick" : "truth");
  return options;
}

std::vector<TruthCell> cells_of(const TruthOptions& options) {
  if (!options.scenes.empty()) return truth_scene_files(options.scenes);
  const TruthBodies bodies{options.bodies, std::max(10, options.bodies * 3 / 10)};
  std::vector<TruthCell> all = truth_design(static_cast<std::uint64_t>(options.design), options.count, bodies);
  if (options.design == 1 && (!options.quick || !options.cells.empty()))
    for (TruthCell& scene : truth_scenes()) all.push_back(std::move(scene));
  if (options.cells.empty()) return all;
  std::vector<TruthCell> chosen;
  const auto add = [&](const TruthCell& cell) {
    if (std::ranges::find(chosen, cell.name, &TruthCell::name) == chosen.end()) chosen.push_back(cell);
  };
  for (const std::string& text : options.cells) {
    const auto named = truth_cell_named(text, bodies);
    bool found = named.has_value();
    if (named) add(*named);
    for (const TruthCell& cell : all) {
      if (cell.name.find(text) == std::string::npos) continue;
      add(cell);
      found = true;
    }
    if (!found)
      throw std::invalid_argument(fmt::format("--cells {}: no cell has this name, or this in its name", text));
  }
  return chosen;
}

/// The file that the cell's scene is read from, written if it is made here.
fs::path scene_file_of(const TruthCell& cell, const fs::path& folder) {
  if (!cell.file.empty()) return cell.file;
  if (cell.text.empty()) return find_scene(cell.name);
  fs::path file = folder / "scenes" / (cell.name + ".toml");
  fs::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << cell.text;
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
  const bool has_mesh = cell.text.find("shapes/") != std::string::npos;
  if (has_mesh && !fs::exists(file.parent_path() / "shapes"))
    fs::copy(scene_folder() / "shapes", file.parent_path() / "shapes", fs::copy_options::recursive);
  return file;
}

std::vector<TruthTask> tasks_of(const TruthOptions& options) {
  std::vector<TruthTask> tasks;
  for (const TruthCell& cell : cells_of(options)) {
    const fs::path scene = scene_file_of(cell, options.out);
    const std::string identity = fmt::format("scene {:016x}", hash_of(contents_of(scene)));
    std::vector<std::string> engines = backends(cell.dimension);
    if (!options.backends.empty()) {
      std::erase_if(engines, [&](const std::string& engine) {
        return std::ranges::find(options.backends, engine) == options.backends.end();
      });
    } else if (options.quick && !engines.empty()) {
      engines.resize(1);
    }
    for (const std::string& engine : engines) tasks.push_back({cell, engine, scene, identity});
  }
  return tasks;
}

BenchCase case_of(const TruthTask& task, const std::string& policy, const TruthOptions& options) {
  return {.scene = task.scene.string(),
          .backend = task.backend,
          .policy = policy,
          .settings = policy == "adaptive" ? options.settings : std::vector<std::string>()};
}

RowKey truth_key(const TruthUnit& unit, const std::string& policy, const TruthOptions& options) {
  RowKey key = key_of(case_of(unit.task, policy, options));
  key.version = unit.task.identity;
  if (policy == "adaptive") key.version += ", " + program_identity();
  key.round = unit.seed;
  return key;
}

/// Independent run `seed` of a case. Nothing is random in a scene without sources and stones: there its first body is
/// moved by a micrometre a run instead.
AnyScene independent_run(BenchCase bench_case, int seed) {
  AnyScene scene = load(bench_case);
  if (seed == 1) return scene;
  const auto first = std::visit([](const auto& each) { return each.seed; }, scene);
  bench_case.settings.push_back(fmt::format("seed={}", first + 1000 * static_cast<std::uint64_t>(seed - 1)));
  scene = load(bench_case);
  std::visit(
      [&](auto& each) {
        if (each.sources.empty()) each.bodies.front().def.pose.position[0] += 1e-6 * (seed - 1);
      },
      scene);
  return scene;
}

template <int Dim>
void draw_truth(const Scene<Dim>& scene, const TruthRun<Dim>& run, const fs::path& png) {
  fs::create_directories(png.parent_path());
  fs::path svg = png;
  svg.replace_extension(".svg");
  draw_pile(
      svg, png,
      PictureInput<Dim>{scene.world.shapes, run.last, run.piles, scene.world.obstacles, scene.world.ground, "", ""},
      {.width = 800, .height = 600, .font_size = 16.0, .samples = 1});
  fs::remove(svg);
}

/// Runs what is missing of the unit: its rows as lines.
std::string measure_unit(const TruthUnit& unit, const RowStore& store, const TruthOptions& options) {
  std::string rows;
  for (const std::string policy : truth_policies) {
    const RowKey key = truth_key(unit, policy, options);
    if (store.find(key) != nullptr) continue;
    const auto measure = [&]<int Dim>(const Scene<Dim>& scene) {
      const TruthRunParams params{policy != reference_policy, policy == "adaptive" ? 8 : 0,
                                  !unit.task.cell.file.empty()};
      const TruthRun<Dim> run = truth_run(scene, unit.task.backend, unit.task.cell.geometry, params);
      rows += line_of({key, "", run.values});
      if (unit.seed == 1 && policy != reference_policy)
        draw_truth(scene, run, picture_file(options.out, unit.task.cell.name, unit.task.backend, policy));
    };
    std::visit(measure, independent_run(case_of(unit.task, policy, options), unit.seed));
  }
  return rows;
}

bool is_complete(const TruthUnit& unit, const RowStore& store, const TruthOptions& options) {
  return std::ranges::all_of(
      truth_policies, [&](const char* policy) { return store.find(truth_key(unit, policy, options)) != nullptr; });
}

void measure_missing(const std::vector<TruthTask>& tasks, RowStore& store, const TruthOptions& options) {
  std::vector<TruthUnit> units;
  for (int seed = 1; seed <= options.seeds; ++seed) {
    for (const TruthTask& task : tasks) {
      const TruthUnit unit{task, seed};
      if (!is_complete(unit, store, options)) units.push_back(unit);
    }
  }
  Stopwatch watch;
  double spent = 0.0;
  std::size_t finished = 0;
  in_processes(
      static_cast<int>(units.size()), options.jobs,
      [&](int i) { return measure_unit(units[static_cast<std::size_t>(i)], store, options); },
      [&](int i, const TaskOutcome& outcome) {
        const TruthUnit& unit = units[static_cast<std::size_t>(i)];
        ++finished;
        spent += watch.lap();
        if (!outcome.failed) {
          std::istringstream lines(outcome.text);
          for (std::string line; std::getline(lines, line);) store.add(row_of(line));
        }
        const double left = spent / static_cast<double>(finished) * static_cast<double>(units.size() - finished);
        print_message("[{}/{}] {} {} seed {}{}; about {:.0f} s left", finished, units.size(), unit.task.cell.name,
                      unit.task.backend, unit.seed, outcome.failed ? ": failed and left out: " + outcome.text : "",
                      left);
      });
}

TruthRow row_of_task(const TruthTask& task, const RowStore& store, const TruthOptions& options) {
  TruthRow row{{task.cell.name, task.backend, task.cell.dimension, task.cell.friction, {}, {}, {}}, {}};
  for (int seed = 1; seed <= options.seeds; ++seed) {
    const TruthUnit unit{task, seed};
    if (!is_complete(unit, store, options)) continue;
    const auto values = [&](const std::string& policy) { return store.find(truth_key(unit, policy, options))->values; };
    row.runs.full.push_back(values("full"));
    row.runs.reference.push_back(values(reference_policy));
    row.runs.adaptive.push_back(values("adaptive"));
  }
  row.result = truth_result(row.runs);
  return row;
}

std::vector<std::string> notes_of(const TruthOptions& options) {
  if (!options.scenes.empty())
    return {
        fmt::format("{} independent seeds; each run lasts as long as the `[run]` frames of its scene. Where nothing "
                    "is random, a run differs from the next by a micrometre in the place of the first body.",
                    options.seeds)};
  return {
      fmt::format("{} bodies a cell, at 0.5 a second three tenths of them; {} independent seeds; each run ends ten "
                  "seconds after the pour (in other gravity as long as takes the same motion there).",
                  options.bodies, options.seeds),
      fmt::format("Cells: the first {} rows of the covering design of seed {}. Each row is the best of 50 that begin "
                  "with one of the rarest pairs of values and add the values whose pairs are rarest.",
                  options.count, options.design),
      "In 3D triangles are tetrahedra, discs balls, and a slope, bin or hopper has the same section along both axes "
      "(a slope along one). The rolling friction of discs and balls is 0.8 of their friction. Scenes of the paper have "
      "their own bodies."};
}

/// A sentence that lists the failed units; empty if none failed.
std::string left_out(const std::vector<TruthTask>& tasks, const RowStore& store, const TruthOptions& options) {
  std::vector<std::string> units;
  for (const TruthTask& task : tasks)
    for (int seed = 1; seed <= options.seeds; ++seed)
      if (!is_complete({task, seed}, store, options))
        units.push_back(fmt::format("{} on {}, seed {}", task.cell.name, task.backend, seed));
  if (units.empty()) return {};
  return fmt::format("Left out of all means, since their runs failed: {}.", fmt::join(units, "; "));
}

/// Measures the same again; folder and number of jobs are left out.
std::string truth_command_line(const TruthOptions& options) {
  std::string command =
      !options.scenes.empty()
          ? fmt::format("talus bench truth{} --seeds {} --scenes {}", options.quick ? " --quick" : "", options.seeds,
                        fmt::join(options.scenes, " "))
          : fmt::format("talus bench truth{} --design {} --count {} --seeds {} --bodies {}",
                        options.quick ? " --quick" : "", options.design, options.count, options.seeds, options.bodies);
  if (!options.cells.empty()) command += fmt::format(" --cells {}", fmt::join(options.cells, ","));
  for (const std::string& engine : options.backends) command += " --backend " + engine;
  for (const std::string& setting : options.settings) command += fmt::format(" --set '{}'", setting);
  return command;
}

}  // namespace

void bench_truth(const TruthOptions& options) {
  const TruthOptions all = completed_truth(options);
  const std::vector<TruthTask> tasks = tasks_of(all);
  for (const TruthTask& task : tasks) load(case_of(task, "adaptive", all));  // a bad --set is refused before any run
  RowStore store(all.out / "rows.jsonl");
  measure_missing(tasks, store, all);
  std::vector<TruthRow> rows;
  for (const TruthTask& task : tasks) rows.push_back(row_of_task(task, store, all));
  BenchResults results{"Truth: errors of adaptive over scenes", notes_of(all), {}};
  if (std::string failed = left_out(tasks, store, all); !failed.empty()) results.notes.push_back(std::move(failed));
  results.command = truth_command_line(all);
  report_truth(all.out, std::move(rows), std::move(results));
}

}  // namespace talus

#include "tools/bench/published.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "common/text/file.h"
#include "common/text/printable.h"
#include "tools/bench/published_run.h"
#include "tools/bench/published_table.h"
#include "tools/output/csv.h"
#include "tools/output/output.h"
#include "tools/pool/in_processes.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"
#include "tools/run/make_simulation.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// Those whose scenes are named; all where none is.
std::vector<Experiment> chosen(std::vector<Experiment> all, const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const Experiment& each : all)
    if (std::ranges::count(known, each.name) == 0) known.push_back(each.name);
  for (const std::string& name : names)
    if (std::ranges::count(known, name) == 0)
      throw std::invalid_argument(
          fmt::format("{} {}: must be one of {}", published_word, name, fmt::join(known, ", ")));
  if (!names.empty())
    std::erase_if(all, [&](const Experiment& each) { return std::ranges::count(names, each.name) == 0; });
  return all;
}

/// Row by row, the seeds side by side. What is wrong with a scene shows before the first run.
std::vector<PublishedRun> runs_of(const std::vector<Experiment>& experiments, const BenchOptions& options) {
  std::vector<PublishedRun> runs;
  for (const Experiment& experiment : experiments) {
    const int dimension = std::visit([]<int Dim>(const Scene<Dim>&) { return Dim; }, read_scene(experiment.scene));
    for (std::size_t row = 0; row < experiment.rows.size(); ++row) {
      for (const std::string& engine : backends(dimension)) {
        if (!options.backends.empty() && std::ranges::count(options.backends, engine) == 0) continue;
        for (const std::string& policy : options.policies) {
          for (int seed = 1; seed <= options.seeds; ++seed) {
            BenchCase run{experiment.scene, engine, policy, experiment.rows[row].settings, seed};
            if (seed == 1)
              std::visit([&](const auto& scene) { check_window(scene, engine, experiment.scene, options.force); },
                         load(run));
            runs.push_back({.experiment = &experiment, .row = row, .run = std::move(run)});
          }
        }
      }
    }
  }
  if (runs.empty()) throw std::invalid_argument("--backend: no experiment runs on this engine");
  for (PublishedRun& run : runs) run.same_as = std::ranges::find(runs, run.run, &PublishedRun::run) - runs.begin();
  return runs;
}

/// The value of a row in the summary of a run; NaN where it has none.
double value_in(const nlohmann::json& summary, const PublishedRun& run) {
  const Experiment& experiment = *run.experiment;
  const std::string& own = experiment.rows[run.row].value;
  const nlohmann::json::json_pointer key(own.empty() ? experiment.value : own);
  const bool known = summary.contains(key) && (summary.at(key).is_number() || summary.at(key).is_boolean());
  if (!known) return BenchNumbers::none;
  const double value = summary.at(key).is_boolean() ? summary.at(key).get<bool>() : summary.at(key).get<double>();
  const double divided = value / experiment.over;
  return experiment.at_least ? (divided >= *experiment.at_least ? 1.0 : 0.0) : divided;
}

void write_results(const std::vector<PublishedRun>& runs, const BenchOptions& options) {
  std::string text = "run,experiment,setting,engine,policy,seed,value,wall_s,failure\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PublishedRun& each = runs[i];
    text += csv_line({fmt::format("{}", i), each.experiment->name, each.experiment->rows[each.row].name,
                      each.run.backend, each.run.policy, fmt::format("{}", each.run.seed),
                      std::isfinite(each.value) ? fmt::format("{:.9g}", each.value) : "",
                      fmt::format("{:.3f}", each.seconds), each.failure});
  }
  write_file(options.out / "runs.csv", text);
  write_file(options.out / "published.md", published_page(runs, options.policies));
}

/// What one simulation gives: the value of each run that it stands for, and the wall time of its steps.
std::string outcome_of(const std::vector<PublishedRun>& runs, std::size_t simulated, const fs::path& folder) {
  const nlohmann::json summary = published_run(runs[simulated].run, folder);
  std::string text = fmt::format("{:.3f}", summary.at("wall_s").get<double>());
  for (const PublishedRun& run : runs)
    if (run.same_as == simulated) text += fmt::format(" {:.17g}", value_in(summary, run));
  return text;
}

void take_outcome(std::vector<PublishedRun>& runs, std::size_t simulated, const TaskOutcome& outcome) {
  std::istringstream text(outcome.failed ? "" : outcome.text);
  std::string seconds, value;
  text >> seconds;
  for (PublishedRun& run : runs) {
    if (run.same_as != simulated) continue;
    if (outcome.failed) {
      run.failure = outcome.text;
      continue;
    }
    text >> value;
    run.seconds = std::stod(seconds);
    run.value = std::stod(value);
  }
}

/// After each simulation the files have what is measured so far.
void do_published(std::vector<PublishedRun>& runs, const BenchOptions& options) {
  std::vector<std::size_t> simulated;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].same_as == i) simulated.push_back(i);
  std::size_t done = 0;
  in_processes(
      static_cast<int>(simulated.size()), options.jobs,
      [&](int i) { return outcome_of(runs, simulated[i], options.out / fmt::format("run_{:04}", simulated[i])); },
      [&](int i, const TaskOutcome& outcome) {
        take_outcome(runs, simulated[i], outcome);
        write_results(runs, options);
        const PublishedRun& run = runs[simulated[i]];
        print_message("[{}/{}] {}, {}, {}, {}, seed {}: {}", ++done, simulated.size(), run.experiment->name,
                      run.experiment->rows[run.row].name, run.run.backend, run.run.policy, run.run.seed,
                      outcome.failed ? "failed: " + outcome.text : fmt::format("{:.4g}", run.value));
      });
}

}  // namespace

int bench_published(const BenchOptions& given) {
  BenchOptions options = given;
  if (options.policies.empty()) options.policies = {"full", "adaptive"};
  if (options.seeds == 0) options.seeds = 4;
  const std::vector<std::string> names(options.scenes.begin() + 1, options.scenes.end());
  const std::vector<Experiment> experiments =
      chosen(read_experiments(scene_folder() / published_word / "experiments.toml"), names);
  std::vector<PublishedRun> runs = runs_of(experiments, options);
  fs::create_directories(options.out);
  do_published(runs, options);
  const auto failed = std::ranges::count_if(runs, [](const PublishedRun& run) { return !run.failure.empty(); });
  print_result("{} runs, {} failed: {}/published.md, runs.csv\n", runs.size(), failed, printable(options.out.string()));
  return failed == 0 ? exit_codes::success : exit_codes::failed;
}

}  // namespace talus

#include "tools/sweep/sweep_command.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "common/scene/read_scene.h"
#include "common/text/file.h"
#include "common/text/printable.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/pool/in_processes.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"
#include "tools/run/interrupt.h"
#include "tools/run/make_simulation.h"
#include "tools/run/measured_drift.h"
#include "tools/run/run_scene.h"
#include "tools/sweep/sweep_plan.h"
#include "tools/sweep/sweep_table.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr const char* footer =
    "Examples:\n"
    "  talus sweep drop_in_a_pile_2d --set shape.L.friction=0.2:1.0:0.2 --seeds 8 --out friction\n"
    "  talus sweep scene.toml --set policy.kind=full,adaptive --set source[0].rate=2,4,8 --jobs 4 --out rates\n\n"
    "Each run is what `talus run` gives with the same values: same bits, same folder. A sweep that was stopped goes "
    "on\n"
    "where it was when it is started again. sweep.csv and sweep.svg have the results.\n"
    "Exit code: 0 all runs finished, 1 some did not (with --strict: or gave a warning), 2 bad input, 130 interrupted.";

struct SweepOptions {
  std::string scene;
  std::vector<std::string> settings;
  int seeds = 1;
  std::string backend;
  std::string policy;  // empty: the scene's
  bool force = false;
  bool strict = false;
  bool measure_drift = false;
  bool probe_drift = true;
  int jobs = 0;  // 0: one for each core
  fs::path out;
  std::string plot = "centre_height_m";
};

std::vector<SweepAxis> axes_of(const SweepOptions& options) {
  std::vector<SweepAxis> axes;
  for (const std::string& setting : options.settings) axes.push_back(sweep_axis(setting));
  if (!options.policy.empty()) axes.push_back({"policy.kind", {options.policy}});
  SweepAxis seeds{"seed", {}};
  for (int seed = 1; seed <= options.seeds; ++seed) seeds.values.push_back(fmt::format("{}", seed));
  if (options.seeds > 1) axes.push_back(seeds);
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (axes[i].path == axes[k].path)
        throw std::invalid_argument(fmt::format("--set {}: must be given once", axes[i].path));
  return axes;
}

std::vector<std::string> settings_of(const std::vector<SweepAxis>& axes, const SweepRun& run) {
  std::vector<std::string> settings;
  for (std::size_t i = 0; i < axes.size(); ++i) settings.push_back(axes[i].path + "=" + run.values[i]);
  return settings;
}

template <int Dim>
void check_run(const SweepOptions& options, const Scene<Dim>& scene, const fs::path& file) {
  const std::vector<std::string> engines = backends(Dim);
  const std::string& backend = options.backend.empty() && !engines.empty() ? engines.front() : options.backend;
  check_window(scene, backend, file, options.force);
  if (options.measure_drift) require_measurable_drift(scene);
}

/// Each value must make a scene that can be read and lies in the engine's window: all errors before the first run.
void check_runs(const SweepOptions& options, const fs::path& scene, const std::vector<SweepAxis>& axes,
                const std::vector<SweepRun>& runs) {
  for (const SweepRun& run : runs) {
    std::vector<Override> overrides;
    for (std::string& setting : settings_of(axes, run)) overrides.push_back({std::move(setting)});
    const AnyScene read = read_scene(scene, overrides);
    std::visit([&](const auto& of_dimension) { check_run(options, of_dimension, scene); }, read);
  }
}

/// What makes a sweep the same when it is started again.
std::string identity(const SweepOptions& options, const fs::path& scene, const std::vector<SweepAxis>& axes) {
  nlohmann::json json = {{"scene", scene.stem().string()},     {"text", file_contents(scene).value_or("")},
                         {"backend", options.backend},         {"measure_drift", options.measure_drift},
                         {"probe_drift", options.probe_drift}, {"axes", nlohmann::json::array()}};
  for (const SweepAxis& axis : axes) json["axes"].push_back({{"path", axis.path}, {"values", axis.values}});
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// Makes the folder, or finds there the sweep that was stopped.
void enter_folder(const fs::path& folder, const std::string& same) {
  const fs::path file = folder / "sweep.json";
  std::error_code unused;
  if (fs::is_directory(folder, unused) && !fs::is_empty(folder, unused)) {
    if (file_contents(file) != same)
      throw std::invalid_argument(
          fmt::format("--out {}: must be new, empty, or of the same sweep of the same scene", folder.string()));
    return;
  }
  fs::create_directories(folder);
  write_file(file, same);
}

fs::path folder_of(const fs::path& sweep, int number) { return sweep / fmt::format("run_{:04}", number); }

nlohmann::json summary_of(const fs::path& folder) {
  std::ifstream stream(folder / "summary.json");
  auto summary = nlohmann::json::parse(stream, nullptr, false);
  return summary.is_object() ? summary : nlohmann::json::object();
}

/// Why the run of a folder ended; empty where it has no summary.
std::string reason_of(const fs::path& folder) { return summary_of(folder).value("reason", ""); }

bool is_finished(const fs::path& folder) { return reason_of(folder) == "finished"; }

/// Warnings of a run about scene, window and what happened.
std::size_t warnings_of(const fs::path& folder) {
  const nlohmann::json summary = summary_of(folder);
  std::size_t count = 0;
  for (const char* kind : {"outside_window", "scene_warnings", "warnings"})
    if (summary.contains(kind)) count += summary[kind].size();
  return count;
}

/// In a process of its own, whose standard output nobody reads.
std::string run_one(const SweepOptions& options, const fs::path& scene, std::vector<std::string> settings,
                    const fs::path& folder) {
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
  fs::remove_all(folder);
  RunOptions run;
  run.scene = scene.string();
  run.backend = options.backend;
  run.force = options.force;
  run.measure_drift = options.measure_drift;
  run.probe_drift = options.probe_drift;
  run.settings = std::move(settings);
  run.out = folder;
  run.telemetry = false;
  run.hash_only = true;
  run_scene(run);
  return {};
}

/// What became of the runs of a sweep.
struct SweepEnd {
  int failed = 0;
  bool stopped = false;  // by a signal, before all had begun or ended
};

/// Says once that a signal has come, and what it does.
class StopNotice {
 public:
  bool requested() {
    if (!interrupt_.requested()) return false;
    if (!told_)
      print_message(
          "interrupted: no run begins any more, and those at work save what they have; the same command goes on later");
    told_ = true;
    return true;
  }

 private:
  Interrupt interrupt_;
  bool told_ = false;
};

std::string word_for(const TaskOutcome& outcome, const fs::path& folder) {
  if (outcome.failed) return ": failed " + outcome.text;
  const std::string reason = reason_of(folder);
  if (reason != "finished") return ": " + reason;
  const std::size_t warnings = warnings_of(folder);
  return warnings == 0 ? "" : fmt::format(": {} {}", warnings, warnings == 1 ? "warning" : "warnings");
}

/// Runs all that are not finished.
SweepEnd do_runs(const SweepOptions& options, const fs::path& scene, const std::vector<SweepAxis>& axes,
                 const std::vector<SweepRun>& runs) {
  std::vector<int> left;
  for (int i = 0; i < std::ssize(runs); ++i)
    if (!is_finished(folder_of(options.out, i))) left.push_back(i);
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  int done = 0;
  SweepEnd end;
  StopNotice notice;
  in_processes(
      static_cast<int>(left.size()), options.jobs > 0 ? options.jobs : cores,
      [&](int task) {
        return run_one(options, scene, settings_of(axes, runs[left[task]]), folder_of(options.out, left[task]));
      },
      [&](int task, const TaskOutcome& outcome) {
        const fs::path folder = folder_of(options.out, left[task]);
        const bool interrupted = !outcome.failed && reason_of(folder) == "interrupted";
        end.failed += interrupted || (!outcome.failed && is_finished(folder)) ? 0 : 1;
        print_message("{} of {}: {} {}{}", ++done, left.size(), folder.filename().string(),
                      fmt::join(settings_of(axes, runs[left[task]]), " "), word_for(outcome, folder));
      },
      [&] { return notice.requested(); });
  end.stopped = notice.requested();
  return end;
}

std::string title_of_scene(const fs::path& scene) {
  return std::visit([](const auto& read) { return printable(read.title); }, read_scene(scene));
}

int sweep(const SweepOptions& options) {
  const fs::path scene = fs::absolute(find_scene(options.scene));
  const std::vector<SweepAxis> axes = axes_of(options);
  const std::vector<SweepRun> runs = sweep_runs(axes);
  check_runs(options, scene, axes, runs);
  enter_folder(options.out, identity(options, scene, axes));
  const SweepEnd end = do_runs(options, scene, axes, runs);
  std::vector<SweepRow> rows;
  std::int64_t with_warnings = 0;
  for (int i = 0; i < std::ssize(runs); ++i) {
    const fs::path folder = folder_of(options.out, i);
    if (!fs::exists(folder / "summary.json")) continue;
    rows.push_back(sweep_row(i, runs[i], folder));
    with_warnings += warnings_of(folder) > 0 ? 1 : 0;
  }
  write_sweep_csv(options.out / "sweep.csv", axes, rows);
  const bool plotted = write_sweep_plot(options.out / "sweep.svg", title_of_scene(scene), axes, rows, options.plot);
  const std::int64_t finished = std::ranges::count(rows, "finished", &SweepRow::reason);
  print_result("{} runs, {} finished, {} failed{}: {}/sweep.csv{}\n", runs.size(), finished, end.failed,
               with_warnings > 0 ? fmt::format(", {} with warnings", with_warnings) : "",
               printable(options.out.string()), plotted ? ", sweep.svg" : "");
  if (end.stopped && finished < std::ssize(runs)) return exit_codes::interrupted;
  return end.failed == 0 && !(options.strict && with_warnings > 0) ? exit_codes::success : exit_codes::failed;
}

std::vector<std::string> names_of_measures() {
  std::vector<std::string> names;
  for (const SweepMeasure& measure : sweep_measures()) names.emplace_back(measure.name);
  return names;
}

}  // namespace

void add_sweep_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("sweep", "Run a scene with all combinations of values, on all cores");
  command->footer(footer);
  auto options = std::make_shared<SweepOptions>();
  command->add_option("scene", options->scene, "Scene file, or the name of a scene that `talus list` shows")
      ->required()
      ->check(not_empty());
  command
      ->add_option("-s,--set", options->settings,
                   "Values of a key of the scene: PATH=LOW:HIGH:STEP or PATH=A,B,C; may be repeated")
      ->type_name("PATH=VALUES")
      ->allow_extra_args(false);
  command->add_option("--seeds", options->seeds, "Each combination with this many seeds, from 1 on")
      ->check(number_between(1, 100000))
      ->capture_default_str();
  command->add_option("-b,--backend", options->backend, "Engine, as for `talus run`")->check(not_empty());
  command->add_option("-p,--policy", options->policy, "Which bodies may sleep, as for `talus run`; several by --set")
      ->check(not_empty());
  command->add_flag("-f,--force", options->force,
                    "Also outside of the window in which results hold: a warning instead of an error");
  command->add_flag("--strict", options->strict, "Exit with 1 when a scene or run gave a warning");
  command->add_flag("--measure-drift", options->measure_drift,
                    "Measure at the end of each run how far the sleeping bodies move, as `talus run`");
  command->add_flag("!--no-drift-probe", options->probe_drift,
                    "Leave out the estimate of drift at the end of each run, as `talus run`");
  command->add_option("-j,--jobs", options->jobs, "Runs at a time; without it one for each core")
      ->check(number_between(1, 1000));
  command->add_option("-o,--out", options->out, "Folder of the sweep: new, empty, or of the same sweep to go on with")
      ->required()
      ->check(not_empty());
  command->add_option("--plot", options->plot, "Column of the table that sweep.svg shows")
      ->check(CLI::IsMember(names_of_measures()))
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = sweep(*options); });
}

}  // namespace talus

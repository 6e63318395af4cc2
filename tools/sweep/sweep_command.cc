#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

#include "common/scene/read_scene.h"
#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/commands/job_options.h"
#include "tools/output/output.h"
#include "tools/pool/folder_lock.h"
#include "tools/pool/slurm.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"
#include "tools/run/make_simulation.h"
#include "tools/run/measured_drift.h"
#include "tools/sweep/collect.h"
#include "tools/sweep/sweep_runs.h"
#include "tools/sweep/sweep_table.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr const char* footer =
    "Examples:\n"
    "  talus sweep drop_in_a_pile_2d --set shape.L.friction=0.2:1.0:0.2 --seeds 8 --out friction\n"
    "  talus sweep scene.toml --set policy.kind=full,adaptive --set source[0].rate=2,4,8 --jobs 4 --out rates\n"
    "  talus sweep scene.toml --seeds 5000 --out rates --on slurm --sbatch \"-p short\"\n\n"
    "Each run is what `talus run` gives with the same values: same bits, same folder. A sweep that was stopped goes "
    "on\n"
    "where it was when it is started again, or with --resume. sweep.csv and sweep.svg have the results.\n"
    "On slurm an array of jobs does the runs and a job after it collects; the command returns at once.\n"
    "Exit code: 0 all runs finished, or are submitted, 1 some did not (with --strict: or gave a warning), 2 bad "
    "input,\n"
    "130 interrupted.";

struct SweepOptions {
  std::string scene;
  std::vector<std::string> settings;
  int seeds = 1;
  std::string policy;  // empty: the scene's
  bool strict = false;
  JobOptions jobs;
  std::optional<std::string> plot;
  Sweep sweep;  // what else is the sweep's own
};

std::vector<SweepAxis> axes_of(const SweepOptions& options) {
  std::vector<SweepAxis> axes;
  for (const std::string& setting : options.settings) axes.push_back(sweep_axis(setting));
  if (!options.policy.empty()) axes.push_back({"policy.kind", {options.policy}});
  SweepAxis seeds{"seed", {}};
  for (int seed = 1; seed <= options.seeds; ++seed) seeds.values.push_back(fmt::format("{}", seed));
  if (options.seeds > 1) axes.push_back(seeds);
  require_apart(axes);
  return axes;
}

template <int Dim>
void check_run(const Sweep& sweep, const Scene<Dim>& scene) {
  const std::string backend = backend_for(sweep.backend, Dim);
  check_window(scene, backend, sweep.scene, sweep.force);
  if (sweep.measure_drift) require_measurable_drift(scene);
}

/// Each value must make a scene that can be read and lies in the engine's window: all errors before the first run.
/// Returns the files of these scenes.
FileHashes checked_runs(const Sweep& sweep) {
  constexpr int told = 10'000;  // between two lines of progress
  const int size = sweep_size(sweep.axes);
  FileHashes files;
  for (int i = 0; i < size; ++i) {
    if (i > 0 && i % told == 0) print_message("{} of {} scenes checked", i, size);
    std::vector<Override> overrides;
    for (std::string& setting : settings_of(sweep.axes, sweep_run(sweep.axes, i)))
      overrides.push_back({std::move(setting)});
    const AnyScene read = read_scene(sweep.scene, overrides);
    std::visit([&](const auto& of_dimension) { check_run(sweep, of_dimension); }, read);
    add_file_hashes(files, sweep.scene, read);
  }
  return files;
}

int exit_code_of(const SweepOptions& options, const SweepCount& count) {
  return count.finished == count.runs && !count.lacks_plotted && !(options.strict && count.with_warnings > 0)
             ? exit_codes::success
             : exit_codes::failed;
}

int run_here(const SweepOptions& options, const Sweep& sweep) {
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const SweepEnd end = do_runs(sweep, unfinished(sweep), options.jobs.jobs > 0 ? options.jobs.jobs : cores);
  const SweepCount count = collect(sweep);
  return end.interrupted && count.finished < count.runs ? exit_codes::interrupted : exit_code_of(options, count);
}

int write_list(const SweepOptions& options, const Sweep& sweep) {
  std::vector<Task> tasks;
  for (const int number : unfinished(sweep))
    tasks.push_back(
        {number, fmt::format("{}", fmt::join(settings_of(sweep.axes, sweep_run(sweep.axes, number)), " "))});
  if (tasks.empty()) return exit_code_of(options, collect(sweep));
  leave_to_scheduler("sweep", sweep.folder, tasks, options.jobs);
  return exit_codes::success;
}

/// Begins a sweep, or goes on with it, in its folder.
int begin(const SweepOptions& options, const Sweep& sweep) {
  const FolderLock lock(sweep.folder, FolderLock::Kind::whole);
  require_no_jobs(sweep.folder);
  begin_sweep(sweep);
  return options.jobs.listed() ? write_list(options, sweep) : run_here(options, sweep);
}

int begin_new(const SweepOptions& options) {
  Sweep sweep = options.sweep;
  if (options.plot) sweep.plot = *options.plot;
  sweep.folder = fs::absolute(options.jobs.emit.empty() ? options.jobs.out : options.jobs.emit).lexically_normal();
  sweep.scene = fs::absolute(find_scene(options.scene));
  sweep.axes = axes_of(options);
  sweep.files = checked_runs(sweep);
  make_sweep_folder(sweep.folder);
  return begin(options, sweep);
}

int do_one(const Sweep& sweep, int number) {
  if (number >= sweep_size(sweep.axes))
    throw std::invalid_argument(
        fmt::format("--only {}: must be below {}, the number of runs", number, sweep_size(sweep.axes)));
  const FolderLock lock(sweep.folder, FolderLock::Kind::one_task);
  if (is_finished(sweep, number)) return exit_codes::success;
  const SweepEnd end = do_runs(sweep, {number}, 1);
  if (end.interrupted) return exit_codes::interrupted;
  return end.failed == 0 ? exit_codes::success : exit_codes::failed;
}

int tell_status(const Sweep& sweep) {
  const SweepCount count = count_runs(sweep);
  const std::string jobs = jobs_left(sweep.folder);
  print_result("{} runs: {} finished, {} failed, {} begun, {} not begun{}\n", count.runs, count.finished, count.failed,
               count.begun, count.waiting(), jobs.empty() ? "" : "; " + jobs);
  return count.finished == count.runs ? exit_codes::success : exit_codes::failed;
}

/// The sweep of a folder; a plot that is given takes the place of its own.
Sweep known_sweep(const SweepOptions& options, const fs::path& folder) {
  Sweep sweep = read_sweep(folder);
  if (options.plot) sweep.plot = *options.plot;
  return sweep;
}

int sweep(const SweepOptions& options) {
  const JobOptions& jobs = options.jobs;
  if (!jobs.status.empty()) return tell_status(known_sweep(options, jobs.status));
  if (!jobs.collect.empty()) return exit_code_of(options, collect(known_sweep(options, jobs.collect)));
  if (jobs.only) return do_one(known_sweep(options, jobs.resume), *jobs.only);
  return jobs.resume.empty() ? begin_new(options) : begin(options, known_sweep(options, jobs.resume));
}

/// A column of the table, or a number of summary.json.
CLI::Validator is_measure() {
  std::vector<std::string> names;
  for (const SweepMeasure& measure : sweep_measures("")) names.emplace_back(measure.name);
  return CLI::Validator(
      [names](const std::string& text) {
        const bool pointer = text.starts_with('/') && text.find('~') == std::string::npos;
        if (pointer || std::ranges::find(names, text) != names.end()) return std::string();
        return fmt::format("must be a key of summary.json, as /gates/0/net, or one of {}", fmt::join(names, ", "));
      },
      "");
}

/// What a new sweep is made of, the scene first.
std::vector<CLI::Option*> add_plan(CLI::App& command, SweepOptions& options) {
  Sweep& sweep = options.sweep;
  return {
      command.add_option("scene", options.scene, "Scene file, or the name of a scene that `talus list` shows")
          ->check(not_empty()),
      command
          .add_option("-s,--set", options.settings,
                      "Values of a key of the scene: PATH=LOW:HIGH:STEP or PATH=A,B,C; may be repeated")
          ->type_name("PATH=VALUES")
          ->allow_extra_args(false),
      command.add_option("--seeds", options.seeds, "Each combination with this many seeds, from 1 on")
          ->check(whole_number(1, 100000))
          ->capture_default_str(),
      command.add_option("-b,--backend", sweep.backend, "Engine, as for `talus run`")->check(not_empty()),
      command.add_option("-p,--policy", options.policy, "Which bodies may sleep, as for `talus run`; several by --set")
          ->check(not_empty()),
      command.add_flag("-f,--force", sweep.force,
                       "Also outside of the window in which results hold: a warning instead of an error"),
      command.add_flag("--measure-drift", sweep.measure_drift,
                       "Measure at the end of each run how far the sleeping bodies move, as `talus run`"),
      command.add_flag("!--no-drift-probe", sweep.probe_drift,
                       "Leave out the estimate of drift at the end of each run, as `talus run`")};
}

}  // namespace

void add_sweep_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("sweep", "Run a scene with all combinations of values, on all cores");
  command->footer(footer);
  auto options = std::make_shared<SweepOptions>();
  const std::vector<CLI::Option*> plan = add_plan(*command, *options);
  add_job_options(*command, options->jobs, most_sweep_runs, "Runs at a time; without it one for each core");
  command->add_flag("--strict", options->strict, "Exit with 1 when a scene or run gave a warning");
  command
      ->add_option("--plot", options->plot,
                   "What sweep.svg shows: a column of the table, or a number of summary.json, which becomes one, as "
                   "/gates/0/net; centre_height_m without it")
      ->check(is_measure());
  command->callback([options, plan, &exit_code] {
    check_job_options(options->jobs, plan);
    if (options->jobs.is_new() && options->scene.empty())
      throw std::invalid_argument("scene: must be given with --out and --emit");
    exit_code = sweep(*options);
  });
}

}  // namespace talus

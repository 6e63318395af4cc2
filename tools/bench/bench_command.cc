#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "common/scene/scene.h"
#include "common/text/printable.h"
#include "common/world/stopwatch.h"
#include "tools/bench/bench_folder.h"
#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_table.h"
#include "tools/bench/published.h"
#include "tools/commands/commands.h"
#include "tools/commands/job_options.h"
#include "tools/output/output.h"
#include "tools/pool/folder_lock.h"
#include "tools/pool/in_processes.h"
#include "tools/pool/slurm.h"
#include "tools/run/backends.h"
#include "tools/sweep/sweep_plan.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr const char* footer =
    "The folder --out (bench) gets bench.csv with a row for each run, and plots; a benchmark that was stopped goes\n"
    "on when it is started again. On slurm an array of jobs does the runs, those with one scene, engine and seed on\n"
    "one machine, and a job after it collects. `reference` is full at finer settings (docs/accuracy.md); without\n"
    "it in --policy no error of shape is known. Each run gives the bits of `talus run SCENE --policy POLICY\n"
    "--set seed=SEED --set run.until=frames` with the settings of its row.\n"
    "Exit code: 0 all runs finished, 1 some failed (bench.csv says how), 2 bad input.\n"
    "Examples:\n"
    "  talus bench --preset table1 --quick\n"
    "  talus bench drop_in_a_pile_2d --policy full,adaptive,reference --seeds 8\n"
    "  talus bench drop_in_a_pile_2d --policy full,adaptive --set accuracy=fast,standard --drift\n"
    "  talus bench published           # experiments of scenes/published, what others found beside what talus gives";

void require_new_folder(const fs::path& folder) {
  std::error_code unused;
  if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder, unused)))
    throw std::invalid_argument(fmt::format("--out {}: must be a new or an empty folder", folder.string()));
}

std::string name_of(const BenchCase& run) {
  std::string name = fmt::format("{} {} {}", run.scene_name(), run.backend, run.policy);
  for (const std::string& setting : run.settings) name += " " + setting;
  return fmt::format("{} seed {}", name, run.seed);
}

/// Measures cases by their numbers.
void measure(const BenchOptions& options, const std::vector<BenchCase>& cases, const std::vector<int>& numbers) {
  Stopwatch watch;
  double spent = 0.0;
  std::size_t done = 0;
  in_processes(
      static_cast<int>(numbers.size()), options.jobs,
      [&](int i) { return line_of(bench_run(cases[numbers[i]], options.extras)); },
      [&](int i, const TaskOutcome& outcome) {
        keep_outcome(options.out, numbers[i], outcome);
        spent += watch.lap();
        ++done;
        const double left = spent / static_cast<double>(done) * static_cast<double>(numbers.size() - done);
        print_message("[{}/{}] {}{}; about {:.0f} s left", done, numbers.size(), name_of(cases[numbers[i]]),
                      outcome.failed ? ": failed: " + outcome.text : "", left);
      });
}

/// Writes the files and the table of what is measured.
int collect(const BenchOptions& options, const std::vector<BenchCase>& cases) {
  std::vector<BenchRow> rows = kept_rows(options.out, cases);
  compare_rows(rows);
  write_bench_csv(options.out / "bench.csv", rows);
  write_frames_csv(options.out / "frames.csv", rows);
  print_text(bench_summary(rows, options.preset));
  const auto waiting = std::ranges::count(rows, not_measured, &BenchRow::failure);
  const auto failed = std::ssize(rows) - std::ranges::count(rows, "", &BenchRow::failure) - waiting;
  const std::vector<std::string> plots = write_bench_plots(options.out, rows);
  print_result("{} runs, {} failed{}: {}/bench.csv{}{}\n", rows.size(), failed,
               waiting > 0 ? fmt::format(", {} not measured", waiting) : "", printable(options.out.string()),
               plots.empty() ? "" : ", ", fmt::join(plots, ", "));
  return failed + waiting == 0 ? exit_codes::success : exit_codes::failed;
}

/// Of the cases, those without a row.
std::vector<int> unmeasured(const BenchOptions& options, const std::vector<BenchCase>& cases) {
  const std::vector<BenchRow> rows = kept_rows(options.out, cases);
  std::vector<int> numbers;
  for (int i = 0; i < std::ssize(rows); ++i)
    if (!rows[i].failure.empty()) numbers.push_back(i);
  return numbers;
}

std::vector<int> in_round(const std::vector<int>& numbers, const BenchRound& round) {
  std::vector<int> inside;
  std::ranges::copy_if(numbers, std::back_inserter(inside),
                       [&](int number) { return number >= round.first && number < round.first + round.count; });
  return inside;
}

/// A round is one task, so that the times that are compared are of one machine.
int do_round(const BenchOptions& options, const std::vector<BenchCase>& cases, int number) {
  const std::vector<BenchRound> rounds = rounds_of(cases);
  if (number >= std::ssize(rounds))
    throw std::invalid_argument(
        fmt::format("--only {}: must be below {}, the number of rounds", number, rounds.size()));
  const FolderLock lock(options.out, FolderLock::Kind::one_task);
  measure(options, cases, in_round(unmeasured(options, cases), rounds[number]));
  return in_round(unmeasured(options, cases), rounds[number]).empty() ? exit_codes::success : exit_codes::failed;
}

int tell_status(const BenchOptions& options, const std::vector<BenchCase>& cases) {
  const std::vector<BenchRow> rows = kept_rows(options.out, cases);
  const auto waiting = std::ranges::count(rows, not_measured, &BenchRow::failure);
  const auto measured = std::ranges::count(rows, "", &BenchRow::failure);
  for (const BenchRow& row : rows)
    if (!row.failure.empty() && row.failure != not_measured) print_message("{}: {}", name_of(row.run), row.failure);
  const std::string jobs = jobs_left(options.out);
  print_result("{} runs: {} measured, {} failed, {} not measured{}\n", rows.size(), measured,
               std::ssize(rows) - measured - waiting, waiting, jobs.empty() ? "" : "; " + jobs);
  return measured == std::ssize(rows) ? exit_codes::success : exit_codes::failed;
}

/// Begins a benchmark, or goes on with it.
int begin(const BenchOptions& options, const std::vector<BenchCase>& cases, const JobOptions& jobs) {
  make_bench_folder(options.out);
  const FolderLock lock(options.out, FolderLock::Kind::whole);
  require_no_jobs(options.out);
  begin_bench(options);
  const std::vector<int> numbers = unmeasured(options, cases);
  std::vector<Task> tasks;
  const std::vector<BenchRound> rounds = rounds_of(cases);
  for (int i = 0; jobs.listed() && i < std::ssize(rounds); ++i)
    if (const std::vector<int> left = in_round(numbers, rounds[i]); !left.empty())
      tasks.push_back({i, fmt::format("{} {} seed {}", cases[left.front()].scene_name(), cases[left.front()].backend,
                                      cases[left.front()].seed)});
  if (tasks.empty()) {
    measure(options, cases, numbers);
    return collect(options, cases);
  }
  leave_to_scheduler("bench", options.out, tasks, jobs);
  return exit_codes::success;
}

/// The experiments have settings and measures of their own.
void check_published(const BenchOptions& options) {
  if (!options.preset.empty() || !options.settings.empty() || options.quick || options.extras.drift ||
      options.extras.motion_error)
    throw std::invalid_argument("--preset, --set, --quick, --drift, --motion-error: must be left out with published");
}

int published(const BenchOptions& options, const JobOptions& jobs) {
  check_published(options);
  if (jobs.out.empty() || jobs.on != "local")
    throw std::invalid_argument("--emit, --on: must be left out with published");
  require_new_folder(options.out);
  return bench_published(options);
}

int bench(const BenchOptions& given, const JobOptions& jobs) {
  if (!given.scenes.empty() && given.scenes.front() == published_word) return published(given, jobs);
  if (jobs.is_new()) {
    BenchOptions options = completed(given);
    options.out = fs::absolute(options.out).lexically_normal();
    const std::vector<fs::path> files = files_of(options);
    options.scenes.clear();
    for (const fs::path& file : files) options.scenes.push_back(file.string());
    const std::vector<BenchCase> cases = bench_cases(options);
    options.files = hashes_of(options, cases);
    return begin(options, cases, jobs);
  }
  BenchOptions options = read_bench(!jobs.resume.empty()   ? jobs.resume
                                    : !jobs.status.empty() ? jobs.status
                                                           : jobs.collect);
  options.jobs = given.jobs;
  for (std::size_t i = 0; !jobs.resume.empty() && i < options.scenes.size(); ++i)
    require_unchanged(options.files.at(i), options.scenes[i], "the benchmark " + options.out.string());
  const std::vector<BenchCase> cases = bench_cases(options);
  if (!jobs.status.empty()) return tell_status(options, cases);
  if (!jobs.collect.empty()) return collect(options, cases);
  return jobs.only ? do_round(options, cases, *jobs.only) : begin(options, cases, jobs);
}

/// Names between commas. CLI11's own delimiter lets empty ones pass.
CLI::Validator names_of(const std::vector<std::string>& known) {
  const CLI::Validator is_known = CLI::IsMember(known);
  return CLI::Validator(
      [is_known](const std::string& text) {
        std::string error;
        for (const std::string& name : split_outside(text, ','))
          if (error.empty()) error = is_known(name);
        return error;
      },
      is_known.get_description());
}

/// All names in the values of an option. Throws std::invalid_argument where one is there twice.
std::vector<std::string> split(std::string_view option, const std::vector<std::string>& values) {
  if (values.empty()) return values;
  const std::string text = fmt::format("{}", fmt::join(values, ","));
  std::vector<std::string> names = split_outside(text, ',');
  if (has_twins(names)) throw std::invalid_argument(fmt::format("{} {}: must have no value twice", option, text));
  return names;
}

/// What a new benchmark is made of.
std::vector<CLI::Option*> add_plan(CLI::App& command, BenchOptions& options) {
  std::vector<std::string> policies(policy_kinds.begin(), policy_kinds.end());
  policies.emplace_back(reference_policy);
  std::vector<std::string> engines = backends(2);
  for (const std::string& engine : backends(3)) engines.push_back(engine);
  std::vector<std::string> presets;
  std::string about;
  for (const BenchPreset& preset : bench_presets()) {
    presets.emplace_back(preset.name);
    about += fmt::format("{}{}", about.empty() ? "" : "; ", preset.about);
  }
  return {
      command.add_option("scene", options.scenes,
                         "Scene files, or names of scenes that `talus list` shows; or published, and which"),
      command.add_option("--preset", options.preset, "What the paper has: " + about)->check(CLI::IsMember(presets)),
      command.add_option("-p,--policy", options.policies, "Policies, separated by commas; may be repeated")
          ->check(names_of(policies))
          ->allow_extra_args(false),
      command
          .add_option("-b,--backend", options.backends, "Engines, separated by commas; default: each dimension's first")
          ->check(names_of(engines))
          ->allow_extra_args(false),
      command
          .add_option("-s,--set", options.settings,
                      "Values of a key of the scenes: PATH=LOW:HIGH:STEP or PATH=A,B,C; may be repeated")
          ->type_name("PATH=VALUES")
          ->allow_extra_args(false),
      command
          .add_option("--seeds", options.seeds,
                      "Runs of each case, with the seeds from 1 on (3; with --quick 2, published 4)")
          ->check(whole_number(1, 1000)),
      command.add_flag("-q,--quick", options.quick, "Half of each scene's frames, fewer scenes of table1"),
      command.add_flag("-f,--force", options.force, "Run outside of the window in which results hold too"),
      command.add_flag("--drift", options.extras.drift, "Measure how far bodies move once all are woken at the end"),
      command.add_flag("--motion-error", options.extras.motion_error,
                       "Measure the paper's relative error against full; a run then takes three times as long")};
}

}  // namespace

void add_bench_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("bench", "Measure speed-up and error of sleeping policies");
  command->footer(footer);
  auto options = std::make_shared<BenchOptions>();
  auto jobs = std::make_shared<JobOptions>();
  const std::vector<CLI::Option*> plan = add_plan(*command, *options);
  add_job_options(*command, *jobs, most_sweep_runs,
                  "Runs at a time (1); side by side their times are some per cent longer");
  command->callback([=, &exit_code] {
    if (jobs->folders() == 0) jobs->out = "bench";
    check_job_options(*jobs, plan);
    options->out = jobs->emit.empty() ? jobs->out : jobs->emit;
    options->policies = split("--policy", options->policies);
    options->backends = split("--backend", options->backends);
    options->jobs = std::max(1, jobs->jobs);
    exit_code = bench(*options, *jobs);
  });
}

}  // namespace talus

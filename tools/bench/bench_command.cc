#include "tools/bench/bench_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "common/scene/scene.h"
#include "common/simulation/stopwatch.h"
#include "common/text/printable.h"
#include "tools/bench/bench_plan.h"
#include "tools/bench/bench_table.h"
#include "tools/bench/published.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/pool/in_processes.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr const char* footer =
    "The folder --out gets bench.csv with a row for each run, and plots. `reference` is full at settings that are "
    "taken\n"
    "for converged; without it in --policy no error of shape is known. Each run gives the bits of\n"
    "`talus run SCENE --policy POLICY --set seed=SEED` with the settings of its row.\n"
    "Exit code: 0 all runs finished, 1 some failed (bench.csv says how), 2 bad input.\n"
    "Examples:\n"
    "  talus bench --preset table1 --quick\n"
    "  talus bench drop_in_a_pile_2d --policy full,adaptive,reference --seeds 8\n"
    "  talus bench drop_in_a_pile_2d --policy full,adaptive --set policy.adaptive.tolerance=0.02,0.05,0.1 --drift\n"
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

/// One row for each case. After each run bench.csv has what is measured so far.
std::vector<BenchRow> measured_rows(const std::vector<BenchCase>& cases, const BenchOptions& options) {
  std::vector<BenchRow> rows;
  for (const BenchCase& each : cases) rows.push_back({each, {}, {}, {}, "not measured yet"});
  Stopwatch watch;
  double spent = 0.0;
  std::size_t done = 0;
  in_processes(
      static_cast<int>(cases.size()), options.jobs, [&](int i) { return line_of(bench_run(cases[i], options.extras)); },
      [&](int i, const TaskOutcome& outcome) {
        if (outcome.failed)
          rows[i].failure = outcome.text;
        else
          rows[i] = row_of(cases[i], outcome.text);
        write_bench_csv(options.out / "bench.csv", rows);
        spent += watch.lap();
        ++done;
        const double left = spent / static_cast<double>(done) * static_cast<double>(cases.size() - done);
        print_message("[{}/{}] {}{}; about {:.0f} s left", done, cases.size(), name_of(cases[i]),
                      outcome.failed ? ": failed: " + outcome.text : "", left);
      });
  compare_rows(rows);
  return rows;
}

/// The experiments have settings and measures of their own.
void check_published(const BenchOptions& options) {
  if (!options.preset.empty() || !options.settings.empty() || options.extras.drift || options.extras.motion_error)
    throw std::invalid_argument("--preset, --set, --drift, --motion-error: must be left out with published");
}

int bench(const BenchOptions& given) {
  if (!given.scenes.empty() && given.scenes.front() == published_word) {
    check_published(given);
    require_new_folder(given.out);
    return bench_published(given);
  }
  const BenchOptions options = completed(given);
  const std::vector<BenchCase> cases = bench_cases(options);
  require_new_folder(options.out);
  fs::create_directories(options.out);
  const std::vector<BenchRow> rows = measured_rows(cases, options);
  write_bench_csv(options.out / "bench.csv", rows);
  write_frames_csv(options.out / "frames.csv", rows);
  print_text(bench_summary(rows, options.preset));
  const auto failed = std::ranges::count_if(rows, [](const BenchRow& row) { return !row.failure.empty(); });
  const std::vector<std::string> plots = write_bench_plots(options.out, rows);
  print_result("{} runs, {} failed: {}/bench.csv{}{}\n", rows.size(), failed, printable(options.out.string()),
               plots.empty() ? "" : ", ", fmt::join(plots, ", "));
  return failed == 0 ? exit_codes::success : exit_codes::failed;
}

void add_choices(CLI::App& command, BenchOptions& options) {
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
  command.add_option("scene", options.scenes,
                     "Scene files, or names of scenes that `talus list` shows; or published, and which");
  command.add_option("--preset", options.preset, "What the paper has: " + about)->check(CLI::IsMember(presets));
  command.add_option("-p,--policy", options.policies, "Policies, separated by commas; may be repeated")
      ->delimiter(',')
      ->check(CLI::IsMember(policies))
      ->allow_extra_args(false);
  command.add_option("-b,--backend", options.backends, "Engines, separated by commas; default: each dimension's first")
      ->delimiter(',')
      ->check(CLI::IsMember(engines))
      ->allow_extra_args(false);
  command
      .add_option("-s,--set", options.settings,
                  "Values of a key of the scenes: PATH=LOW:HIGH:STEP or PATH=A,B,C; may be repeated")
      ->type_name("PATH=VALUES")
      ->allow_extra_args(false);
}

}  // namespace

void add_bench_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("bench", "Measure speed-up and error of sleeping policies");
  command->footer(footer);
  auto options = std::make_shared<BenchOptions>();
  add_choices(*command, *options);
  command->add_option("--seeds", options->seeds, "Runs of each case, with the seeds from 1 on (3, quick: 2)")
      ->check(CLI::Range(1, 1000));
  command->add_flag("-q,--quick", options->quick, "Half of each scene's frames, fewer scenes of table1");
  command->add_flag("-f,--force", options->force, "Run outside of the window in which results hold too");
  command->add_flag("--drift", options->extras.drift, "Measure how far bodies move once all are woken at the end");
  command->add_flag("--motion-error", options->extras.motion_error,
                    "Measure the paper's relative error against full; a run then takes three times as long");
  command->add_option("-j,--jobs", options->jobs, "Runs at a time; side by side their times are some per cent longer")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("-o,--out", options->out, "Folder for the results, new or empty")
      ->check(not_empty())
      ->capture_default_str();
  command->callback([=, &exit_code] { exit_code = bench(*options); });
}

}  // namespace talus

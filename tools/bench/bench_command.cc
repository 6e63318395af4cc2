#include "tools/bench/bench_command.h"

#include "common/scene/scene.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/truth_command.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

/// For options with a folder that is made where it is not there.
CLI::Validator folder_or_new() {
  return {[](const std::string& text) {
            std::error_code unused;
            const bool usable = !text.empty() &&
                                (std::filesystem::is_directory(text, unused) || !std::filesystem::exists(text, unused));
            return usable ? std::string() : text + ": must be a folder, or the name of a new one";
          },
          ""};
}

void add_options(CLI::App& command, BenchOptions& options) {
  command.add_flag("-q,--quick", options.quick, "A few minutes: fewer scenes, half of their frames, two rounds");
  std::vector<std::string> engines = backends(2);
  for (const std::string& engine : backends(3)) engines.push_back(engine);
  command.add_option("-p,--policy", options.policies, "Policy to measure, may be repeated; default: all there are")
      ->check(CLI::IsMember(std::vector<std::string>(policy_kinds.begin(), policy_kinds.end())))
      ->allow_extra_args(false);
  command.add_option("--scene", options.scenes, "Scene, in both dimensions unless its name has one; may be repeated")
      ->allow_extra_args(false);
  command.add_option("-b,--backend", options.backends, "Engine, may be repeated; default: each dimension's first")
      ->check(CLI::IsMember(engines))
      ->allow_extra_args(false);
  command.add_option("-s,--set", options.settings, "Replace a value of every scene; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  command.add_option("--rounds", options.rounds, "Timed runs of each case (5, quick: 2)")->check(CLI::Range(1, 1000));
  command.add_option("--seeds", options.seeds, "Independent seeds of each case for shapes and drift (3, quick: 1)")
      ->check(CLI::Range(1, 100));
  command.add_option("--share", options.share, "Share of each scene's frames to run, from its start (1, quick: 0.5)")
      ->check(number_between(0.0, 1.0, Bound::left_out));
  command.add_flag("--reference", options.reference, "Errors against the converged simulation too (slow)");
  command.add_flag("!--no-errors", options.errors, "Times only");
  command.add_option("--docs", options.docs, "Folder for the results as Markdown with figures, for manuals")
      ->check(folder_or_new());
  command.add_option("-o,--out", options.out, "Folder of rows and report; rows that are there are not measured again")
      ->check(folder_or_new());
}

}  // namespace

void add_bench_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("bench", "Measure speed-up and error of sleeping policies");
  command->require_subcommand(1);
  command->footer(
      "Each leaves rows.jsonl, results.csv, results.json, results.md and report.html (one page, works offline) in its\n"
      "folder, bench/NAME by default. A benchmark that was stopped continues when called again.\n"
      "Example: talus bench table1 --quick --policy paper");
  for (const Benchmark& benchmark : benchmarks()) {
    CLI::App* one = command->add_subcommand(benchmark.name, benchmark.help);
    auto options = std::make_shared<BenchOptions>();
    add_options(*one, *options);
    one->callback([=, &exit_code] {
      const BenchOptions all = completed(*options, benchmark.name);
      if (all.quick) {
        print_message("Quick: fewer scenes and rounds, {:g} % of each scene's frames; piles are smaller than in full.",
                      100.0 * all.share);
      }
      benchmark.run(all);
      exit_code = exit_codes::success;
    });
  }
  add_truth_command(*command, exit_code);
}

}  // namespace talus

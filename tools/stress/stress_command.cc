#include "tools/stress/stress_command.h"

#include <fmt/format.h>

#include <memory>

#include "common/scene/scene.h"
#include "tools/bench/bench_results.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/run/backends.h"
#include "tools/stress/advise.h"
#include "tools/stress/stress_report.h"

namespace talus {
namespace {

struct StressOptions {
  StressChoice choice;
  std::filesystem::path out;
  std::filesystem::path docs;
  std::filesystem::path history;
  AdviceOptions advice;
  int jobs = 2;
  bool quick = false;
};

constexpr const char* footer =
    "Groups: closed, standing, granular, extremes, piling, peers. Without --long the quick cases run, half a minute "
    "on\n"
    "one core. A cell is a case on an engine under a policy; it is red where a measured quantity lies outside of its\n"
    "tolerance. Exit code 1 where a cell is red for no known reason.\n"
    "Example: talus stress standing --backend box2d --policy adaptive";

std::string command_line(const StressOptions& options) {
  std::string text = "talus stress";
  for (const std::string& name : options.choice.names) text += " " + name;
  text += options.choice.whole ? " --long" : " --quick";
  for (const std::string& backend : options.choice.backends) text += " --backend " + backend;
  for (const std::string& policy : options.choice.policies) text += " --policy " + policy;
  if (!options.docs.empty()) text += " --docs " + options.docs.string();
  return text;
}

BenchResults results_of(const StressOptions& options, const std::vector<StressRow>& rows) {
  BenchResults results{
      "Limits: where results hold",
      {"Each case is measured on each engine under each policy that matters to it, and compared with a "
       "reference from theory, from the law of a measured material, or from the same case "
       "without sleep. A value outside of its tolerance is in bold type; why it is there stands under "
       "[red cells](#red-cells). `refused`: the case lies outside of what a scene may have."},
      stress_sections(rows)};
  results.command = command_line(options);
  return results;
}

void write_report(const StressOptions& options, const std::vector<StressRow>& rows) {
  const std::vector<StressRecord> history = append_history(options.history, rows);
  BenchResults results = results_of(options, rows);
  std::vector<Figure> figures = history_figures(history);
  if (!options.docs.empty()) write_page(options.docs, "limits", results);
  if (!figures.empty()) {
    Section over_time{"Over the versions", {}};
    for (Figure& figure : figures) over_time.blocks.emplace_back(std::move(figure));
    results.sections.push_back(std::move(over_time));
  }
  write_pages(options.out, results);
}

/// Table in the terminal: bold type has no meaning there.
std::string for_terminal(const Table& table) {
  Table plain = table;
  for (std::vector<std::string>& row : plain.rows)
    for (std::string& cell : row)
      if (cell.starts_with("**")) cell = "RED " + cell.substr(2, cell.size() - 4);
  return text_of(plain);
}

int give_advice(StressOptions options) {
  const auto one = [](const std::vector<std::string>& list, const char* option) {
    if (list.size() > 1) throw std::invalid_argument(fmt::format("{}: must be given once with --advise", option));
    return list.empty() ? std::string() : list.front();
  };
  options.advice.backend = one(options.choice.backends, "--backend");
  options.advice.policy = one(options.choice.policies, "--policy");
  options.advice.jobs = options.jobs;
  advise(options.advice);
  return exit_codes::success;
}

int run(StressOptions options) {
  if (!options.advice.scene.empty()) return give_advice(options);
  if (options.out.empty())
    options.out = std::filesystem::path("bench") / (options.choice.whole ? "stress" : "stress-quick");
  if (options.history.empty()) options.history = options.out / "stress.csv";
  const std::vector<StressRow> rows = run_stress(options.choice, options.jobs);
  if (rows.empty()) throw std::invalid_argument("no case runs on the engines and policies that were chosen");
  write_report(options, rows);
  print_text(for_terminal(stress_table(rows)));
  print_result("\n{}\n{}, {}/report.html and results.md\n", in_short(rows), options.history.string(),
               options.out.string());
  int exit_code = exit_codes::success;
  for (const StressRow& row : rows) {
    if (row.outcome != StressOutcome::red) continue;
    print_message("talus: {}", complaint(row));
    exit_code = exit_codes::failed;
  }
  return exit_code;
}

CLI::Validator folder() { return not_empty() & (CLI::ExistingDirectory | CLI::NonexistentPath); }

void add_stress_options(CLI::App& command, StressOptions& options) {
  command.add_option("name", options.choice.names, "Groups or cases; default: all groups");
  auto* quick = command.add_flag("-q,--quick", options.quick, "Only the quick cases; this is the default");
  command.add_flag("-l,--long", options.choice.whole, "All cases, about a quarter of an hour of processor time")
      ->excludes(quick);
  std::vector<std::string> engines = backends(2);
  for (const std::string& engine : backends(3)) engines.push_back(engine);
  command.add_option("-b,--backend", options.choice.backends, "Engine, may be repeated; default: all")
      ->check(CLI::IsMember(engines))
      ->allow_extra_args(false);
  command.add_option("-p,--policy", options.choice.policies, "Policy, may be repeated; default: all")
      ->check(CLI::IsMember(std::vector<std::string>(policy_kinds.begin(), policy_kinds.end())))
      ->allow_extra_args(false);
  command.add_option("-j,--jobs", options.jobs, "Cells at a time, each in a process of its own")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command
      .add_option("-o,--out", options.out,
                  "Folder of stress.csv, report.html and results.md (bench/stress, quick: bench/stress-quick)")
      ->check(folder());
  command.add_option("--docs", options.docs, "Folder for the page limits.md")->check(folder());
  auto* advise =
      command
          .add_option("--advise", options.advice.scene,
                      "Instead run this scene at half, its own and double steps a second and iterations, and "
                      "say which suffice")
          ->check(not_empty())
          ->excludes(quick);
  command
      .add_option("--tolerance", options.advice.tolerance,
                  "What suffices for --advise: heights, radii and overlaps within this of the finest setting's [D]")
      ->check(number_between(0.0, 10.0, Bound::left_out))
      ->needs(advise)
      ->capture_default_str();
  command.add_option("--seeds", options.advice.seeds, "Runs at each setting of --advise")
      ->check(CLI::Range(1, 100))
      ->needs(advise)
      ->capture_default_str();
  command.add_option("--history", options.history, "File of all versions' values; default: stress.csv in --out")
      ->check(not_empty());
}

}  // namespace

void add_stress_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("stress", "Try to break engines and policies: measure where results hold and where not");
  command->footer(footer);
  auto options = std::make_shared<StressOptions>();
  add_stress_options(*command, *options);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace talus

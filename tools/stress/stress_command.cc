#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/scene/scene.h"
#include "tests/physics/physics_case.h"
#include "tools/commands/commands.h"
#include "tools/output/output.h"
#include "tools/pool/in_processes.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

struct StressOptions {
  std::vector<std::string> names;
  std::vector<std::string> backends;
  std::vector<std::string> policies;
  std::vector<std::string> solvers = {std::string(small_steps_solver)};
  int rings = usual_rings;
  int jobs = 2;
  bool whole = false;
};

constexpr const char* footer =
    "Each case lies inside the window in which an engine's results hold, and has numbers that must lie within a\n"
    "tolerance of a reference: from theory, from a law of granular matter, or from the same case without sleep.\n"
    "Exit code: 0 all do, 1 some do not, 2 bad input.\n"
    "Example: talus stress standing --backend box2d --policy adaptive";

bool is_chosen(const std::vector<std::string>& list, std::string_view name) {
  return list.empty() || std::ranges::find(list, name) != list.end();
}

void check_names(const std::vector<std::string>& names) {
  const std::vector<std::string_view> groups = physics_groups();
  for (const std::string& name : names) {
    const bool known = std::ranges::find(groups, name) != groups.end() ||
                       std::ranges::find(physics_cases(), name, &PhysicsCase::name) != physics_cases().end();
    if (!known)
      throw std::invalid_argument(
          fmt::format("{}: must be a group ({}) or the name of a case", name, fmt::join(groups, ", ")));
  }
}

/// Each task with each solver, side by side. The policy `engine` has the engine's own solver alone. The result refers
/// to the options.
std::vector<PhysicsTask> with_solvers(const std::vector<PhysicsTask>& tasks, const StressOptions& options) {
  std::vector<PhysicsTask> all;
  const auto add = [&](PhysicsTask task, std::string_view solver) {
    task.cell.solver = solver;
    task.cell.rings = options.rings;
    all.push_back(task);
  };
  for (const PhysicsTask& task : tasks) {
    if (task.cell.policy == "engine") {
      add(task, engine_solver);
      continue;
    }
    for (const std::string& solver : options.solvers) add(task, solver);
  }
  return all;
}

/// Slow cases only by name or with --long.
std::vector<PhysicsTask> chosen_tasks(const StressOptions& options) {
  check_names(options.names);
  std::vector<PhysicsTask> tasks = physics_tasks();
  std::erase_if(tasks, [&](const PhysicsTask& task) {
    const bool named = !options.names.empty() && is_chosen(options.names, task.each->name);
    const bool in_group = is_chosen(options.names, task.each->group) && (options.whole || !task.each->slow);
    return !(named || in_group) || !is_chosen(options.backends, task.cell.backend) ||
           !is_chosen(options.policies, task.cell.policy);
  });
  if (tasks.empty())
    throw std::invalid_argument(
        "stress: no case runs on the engines and policies that were chosen; slow ones only by name or with --long");
  return with_solvers(tasks, options);
}

/// How many of the case's numbers lie outside of their tolerances; a case that failed has none.
int print_task(const PhysicsTask& task, const TaskOutcome& outcome) {
  const auto numbers = nlohmann::json::parse(outcome.failed ? "[]" : outcome.text);
  int outside = 0;
  for (std::size_t i = 0; i < task.each->gates.size(); ++i) {
    const PhysicsGate& gate = task.each->gates[i];
    const double measured = i < numbers.size() && numbers[i].is_number() ? numbers[i].get<double>() : std::nan("");
    const bool good = gate.holds(measured);
    outside += good ? 0 : 1;
    print_result("  {:<14}{:<10}{:<13}{} = {:.4g}{}{}, must be {:.4g} ± {:.4g}{}\n", task.cell.backend,
                 task.cell.policy, task.cell.solver, gate.quantity, measured, gate.unit.empty() ? "" : " ", gate.unit,
                 gate.reference, gate.tolerance, good ? "" : " OUTSIDE");
    if (!good)
      print_message("talus: {}{}{}", sentence(task, gate, measured), outcome.failed ? ": " : "",
                    outcome.failed ? outcome.text : "");
  }
  return outside;
}

int stress(const StressOptions& options) {
  const std::vector<PhysicsTask> tasks = chosen_tasks(options);
  std::vector<TaskOutcome> outcomes(tasks.size());
  in_processes(
      static_cast<int>(tasks.size()), options.jobs, [&](int i) { return nlohmann::json(tasks[i].measure()).dump(); },
      [&](int i, const TaskOutcome& outcome) { outcomes[i] = outcome; });
  std::size_t numbers = 0;
  int outside = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const PhysicsCase& each = *tasks[i].each;
    if (i == 0 || tasks[i - 1].each != &each) print_result("{}: {}\n", each.name, each.setup);
    numbers += each.gates.size();
    outside += print_task(tasks[i], outcomes[i]);
  }
  print_result("\n{} numbers measured, {} outside of their tolerances\n", numbers, outside);
  return outside == 0 ? exit_codes::success : exit_codes::failed;
}

}  // namespace

void add_stress_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("stress", "Measure what engines and policies must get right");
  command->footer(footer);
  auto options = std::make_shared<StressOptions>();
  command->add_option("name", options->names, "Groups or cases; default: all groups");
  command->add_flag("-l,--long", options->whole, "Slow cases too, some minutes");
  std::vector<std::string> engines = backends(2);
  for (const std::string& engine : backends(3)) engines.push_back(engine);
  command->add_option("-b,--backend", options->backends, "Engine, may be repeated; default: all")
      ->check(CLI::IsMember(engines))
      ->allow_extra_args(false);
  command->add_option("-p,--policy", options->policies, "Policy, may be repeated; default: all")
      ->check(CLI::IsMember(std::vector<std::string>(policy_kinds.begin(), policy_kinds.end())))
      ->allow_extra_args(false);
  command
      ->add_option("--solver", options->solvers,
                   "World's solver of contacts, may be repeated; the policy `engine` has the engine's own in any case")
      ->check(CLI::IsMember(std::vector<std::string>(solver_kinds.begin(), solver_kinds.end())))
      ->allow_extra_args(false)
      ->capture_default_str();
  command
      ->add_option("--rings", options->rings, "Rings of sleeping bodies that policy adaptive solves; with small_steps")
      ->check(whole_number(0, 100))
      ->capture_default_str();
  command->add_option("-j,--jobs", options->jobs, "Runs at a time, each in a process of its own")
      ->check(whole_number(1, most_jobs))
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = stress(*options); });
}

}  // namespace talus

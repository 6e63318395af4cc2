#include "tools/stress/stress_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/scene/scene.h"
#include "tools/bench/in_processes.h"
#include "tools/output/output.h"
#include "tools/run/backends.h"
#include "tools/run/processor_watch.h"

namespace talus {
namespace {

using Json = nlohmann::json;

/// A case in a cell, and the dimension of the cell's engine.
struct StressTask {
  const StressCase* stress_case;
  StressCell cell;
  int dimension = 2;
};

bool chosen(const std::vector<std::string>& list, std::string_view name) {
  return list.empty() || std::ranges::find(list, name) != list.end();
}

std::vector<std::string> policies_for(const StressCase& each) {
  if (each.policies == StressPolicies::full_only) return {"full"};
  if (each.policies == StressPolicies::deciding) return {"paper", "adaptive"};
  return {policy_kinds.begin(), policy_kinds.end()};
}

std::vector<StressTask> tasks_for(const StressChoice& choice) {
  std::vector<StressTask> tasks;
  for (const StressCase* each : chosen_cases(choice))
    for (const int dimension : {2, 3})
      for (const std::string& backend : backends(dimension))
        for (const std::string& policy : policies_for(*each))
          if (each->measure(dimension) && chosen(choice.backends, backend) && chosen(choice.policies, policy))
            tasks.push_back({each, {backend, policy}, dimension});
  return tasks;
}

/// What the task's process returns; NaN becomes null.
std::string measure_task(const StressTask& task) {
  ProcessorWatch watch;
  Json result;
  try {
    result["values"] = task.stress_case->measure(task.dimension)(task.cell);
  } catch (const std::invalid_argument& refusal) {
    result["refused"] = refusal.what();
  }
  result["seconds"] = watch.lap();
  return result.dump();
}

StressRow row_for(const StressTask& task, const StressGate& gate) {
  const StressCase& each = *task.stress_case;
  return {.group = std::string(each.group),
          .name = each.name,
          .quantity = std::string(gate.quantity),
          .unit = std::string(gate.unit),
          .backend = task.cell.backend,
          .policy = task.cell.policy,
          .measured = std::nan(""),
          .reference = gate.reference,
          .tolerance = gate.tolerance};
}

/// Sets outcome and note from what was measured.
void judge(const StressTask& task, const StressGate& gate, StressRow& row) {
  if (gate.holds(row.measured)) return;
  const std::string_view reason = task.stress_case->known_limit(task.cell);
  row.outcome = reason.empty() ? StressOutcome::red : StressOutcome::known;
  row.note = reason.empty() ? std::string(gate.why) : std::string(reason);
}

std::vector<StressRow> rows_for(const StressTask& task, const TaskOutcome& outcome) {
  std::vector<StressRow> rows;
  const Json result = outcome.failed ? Json::object() : Json::parse(outcome.text);
  for (std::size_t i = 0; i < task.stress_case->gates.size(); ++i) {
    StressRow row = row_for(task, task.stress_case->gates[i]);
    row.seconds = result.value("seconds", 0.0);
    if (outcome.failed || result.contains("refused")) {
      const bool right = !outcome.failed && task.stress_case->may_be_refused;
      row.outcome = right ? StressOutcome::refused : StressOutcome::red;
      row.note = outcome.failed ? "failed: " + outcome.text : result["refused"].get<std::string>();
    } else {
      const Json& value = result["values"].at(i);
      if (value.is_number()) row.measured = value.get<double>();
      judge(task, task.stress_case->gates[i], row);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

void show_progress(std::size_t finished, std::size_t all, const StressTask& task) {
  if (isatty(STDERR_FILENO) == 0) return;
  write_note(fmt::format("\r\033[K[{}/{}] {} {} {}{}", finished, all, task.stress_case->name, task.cell.backend,
                         task.cell.policy, finished == all ? "\r\033[K" : ""));
}

}  // namespace

std::string_view to_string(StressOutcome outcome) {
  constexpr std::array<std::string_view, 4> names = {"pass", "known", "red", "refused"};
  return names.at(static_cast<std::size_t>(outcome));
}

std::vector<const StressCase*> chosen_cases(const StressChoice& choice) {
  for (const std::string& name : choice.names) {
    const bool is_group = std::ranges::any_of(stress_groups(), [&](const auto& group) { return group.name == name; });
    if (is_group || std::ranges::find(stress_cases(), name, &StressCase::name) != stress_cases().end()) continue;
    std::string groups;
    for (const StressGroup& group : stress_groups()) groups += fmt::format(" {}", group.name);
    throw std::invalid_argument(fmt::format("{}: must be a group (one of{}) or the name of a case", name, groups));
  }
  std::vector<const StressCase*> cases;
  for (const StressCase& each : stress_cases()) {
    const bool named = !choice.names.empty() && chosen(choice.names, each.name);
    if (named || ((choice.whole || each.quick) && chosen(choice.names, each.group))) cases.push_back(&each);
  }
  return cases;
}

std::vector<StressRow> run_stress(const StressChoice& choice, int jobs) {
  const std::vector<StressTask> tasks = tasks_for(choice);
  std::vector<std::vector<StressRow>> by_task(tasks.size());
  std::size_t finished = 0;
  in_processes(
      static_cast<int>(tasks.size()), jobs, [&](int i) { return measure_task(tasks[i]); },
      [&](int i, const TaskOutcome& outcome) {
        by_task[i] = rows_for(tasks[i], outcome);
        show_progress(++finished, tasks.size(), tasks[i]);
      });
  std::vector<StressRow> rows;
  for (std::vector<StressRow>& some : by_task) std::ranges::move(some, std::back_inserter(rows));
  return rows;
}

std::string complaint(const StressRow& row) {
  return fmt::format("{}/{} on {}, {}: {} = {:.4g}{}{} must be {:.4g} ± {:.4g} ({})", row.group, row.name, row.backend,
                     row.policy, row.quantity, row.measured, row.unit.empty() ? "" : " ", row.unit, row.reference,
                     row.tolerance, row.note);
}

}  // namespace talus

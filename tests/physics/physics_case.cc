#include "tests/physics/physics_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/run/backends.h"

namespace talus {
namespace {

bool is_except(const PhysicsCase& each, const PhysicsCell& cell) {
  const auto fits = [](std::string_view wanted, std::string_view name) { return wanted.empty() || wanted == name; };
  return std::ranges::any_of(each.except, [&](const PhysicsCell& except) {
    return fits(except.backend, cell.backend) && fits(except.policy, cell.policy);
  });
}

/// Names of the engines that outlive the cells.
const std::vector<std::string>& engines(int dimension) {
  static const std::vector<std::string> in_plane = backends(2);
  static const std::vector<std::string> in_space = backends(3);
  return dimension == 2 ? in_plane : in_space;
}

}  // namespace

bool PhysicsGate::holds(double measured) const {
  return std::isfinite(measured) && std::abs(measured - reference) <= tolerance;
}

std::vector<std::string_view> physics_groups() { return {"closed", "standing", "heaps", "window", "sleeping"}; }

const std::vector<PhysicsCase>& physics_cases() {
  static const std::vector<PhysicsCase> all = [] {
    std::vector<PhysicsCase> cases;
    for (const auto group : {closed_form_cases, standing_cases, heap_cases, window_edge_cases, sleeping_cases})
      std::ranges::move(group(), std::back_inserter(cases));
    return cases;
  }();
  return all;
}

std::vector<PhysicsTask> physics_tasks() {
  std::vector<PhysicsTask> tasks;
  for (const PhysicsCase& each : physics_cases())
    for (const int dimension : {2, 3})
      for (const std::string& engine : engines(dimension))
        for (const std::string_view policy : each.policies)
          if (each.measure(dimension) && !is_except(each, {engine, policy}))
            tasks.push_back({&each, {engine, policy}, dimension});
  return tasks;
}

std::string sentence(const PhysicsTask& task, const PhysicsGate& gate, double measured) {
  return fmt::format("{} on {}, {}: {} = {:.4g}{}{} must be {:.4g} ± {:.4g} ({})", task.each->name, task.cell.backend,
                     task.cell.policy, gate.quantity, measured, gate.unit.empty() ? "" : " ", gate.unit, gate.reference,
                     gate.tolerance, gate.why);
}

}  // namespace talus

#include "tools/stress/stress_case.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace talus {

bool StressGate::holds(double measured) const {
  return std::isfinite(measured) && std::abs(measured - reference) <= tolerance;
}

std::string_view StressCase::known_limit(const StressCell& cell) const {
  const auto fits = [](std::string_view wanted, std::string_view value) { return wanted.empty() || wanted == value; };
  const auto found = std::ranges::find_if(known, [&](const KnownLimit& limit) {
    return fits(limit.backend, cell.backend) && fits(limit.policy, cell.policy);
  });
  return found == known.end() ? std::string_view() : found->reason;
}

const std::vector<StressCase>& stress_cases() {
  static const std::vector<StressCase> all = [] {
    std::vector<StressCase> cases;
    for (const auto group :
         {closed_form_cases, standing_cases, granular_cases, extreme_cases, piling_cases, peer_cases})
      std::ranges::move(group(), std::back_inserter(cases));
    return cases;
  }();
  return all;
}

const std::vector<StressGroup>& stress_groups() {
  static const std::vector<StressGroup> groups = {
      {"closed", "Motions with a solution in closed form."},
      {"standing", "Structures that stand by the laws of statics."},
      {"granular", "Heaps, packings and flows against measured laws of granular matter."},
      {"extremes", "Settings, sizes, places and speeds at the edge of what a scene may have, and beyond it."},
      {"piling", "Freezing and waking under load: what a policy may break."},
      {"peers", "Tests that other simulators publish, rebuilt from their numbers."}};
  return groups;
}

}  // namespace talus

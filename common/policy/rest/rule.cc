#include "common/policy/rest/rule.h"

#include <algorithm>

namespace talus {

template <int Dim>
VelocityChange<Dim>& RuleOutput<Dim>::velocity_of(BodyIndex body, const BodyStates<Dim>& states) {
  const auto entry = std::ranges::lower_bound(velocities, body, {}, &VelocityChange<Dim>::body);
  if (entry != velocities.end() && entry->body == body) return *entry;
  return *velocities.insert(entry, {.body = body, .velocity = states.velocity[body], .spin = states.spin[body]});
}

template <int Dim>
void RuleOutput<Dim>::clear() {
  wakes.clear();
  velocities.clear();
}

template struct RuleOutput<2>;
template struct RuleOutput<3>;

}  // namespace talus

#pragma once
// What rules of the policy `adaptive` are made from and called with, in tests with cubes of 1 m and 1 kg.

#include <vector>

#include "common/policy/rest/rule.h"
#include "tests/common/cubes.h"

namespace talus {

/// What a rule is made from.
struct RuleParts {
  AdaptiveParams params{};
  double extent = 1.7320508075688772;  // D [m]; by default the cube's diagonal
  WorldDescription<3> world = cubes();
  TypicalBody typical{.bounding_volume = 1.0, .extent = extent, .mass = 1.0};

  RuleSetup<3> setup() const { return {.params = params, .typical = typical, .world = world}; }
};

/// A still world after a step.
inline RuleInput<3> input(const StillWorld<3>& world, std::int64_t step = 0, std::span<const Pile<3>> piles = {}) {
  return {.world = world, .contacts = world.touching, .piles = piles, .step = step};
}

/// The bodies in a list, ascending.
inline std::vector<BodyIndex> bodies_in(const WakeList& wakes) {
  std::vector<BodyIndex> bodies;
  for (const auto& [body, wake] : wakes) bodies.push_back(body);
  return bodies;
}

/// A contact of bodies `a` and `b`; `normal` points from b to a.
inline Contact<3> contact(BodyIndex a, BodyIndex b, const Vec3& point, const Vec3& normal, double impulse) {
  return {.a = a, .b = b, .point = point, .normal = normal, .normal_impulse = impulse};
}

}  // namespace talus

#pragma once
// What the rules of the policy `adaptive` have in common: what they are made from, what they see of a step, and what
// they may change. Each rule is a class with a constructor from RuleSetup and a function update(RuleInput, RuleOutput)
// that is called once a step.

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "common/pile/pile.h"
#include "common/policy/rest/adaptive_params.h"
#include "common/policy/sleep_policy.h"
#include "common/world/world.h"

namespace talus {

/// What a rule is made from; references are needed during the rule's constructor only. Gravity may change in a run, so
/// a rule takes it from the world of each step.
template <int Dim>
struct RuleSetup {
  const AdaptiveParams& params;
  const TypicalBody& typical;  // gives D and the mass of a body
  const WorldDescription<Dim>& world;
};

/// One finished step; references are valid during one update().
template <int Dim>
struct RuleInput {
  const World<Dim>& world;
  std::span<const Contact<Dim>> contacts;  // those of the world; with a ring, none for rules that need none
  std::span<const Pile<Dim>> piles;
  std::int64_t step = 0;  // steps done, 1 after the first

  const BodyStates<Dim>& states() const { return world.states(); }
  const Shape<Dim>& shape_of(BodyIndex body) const { return world.shape_of(body); }
  const Pose<Dim>& pose_of(BodyIndex body) const { return states().pose[body]; }
  bool asleep(BodyIndex body) const { return states().asleep[body] != 0; }
  /// How far a vector reaches against gravity: of unit vectors from -1 to 1.
  double rise(const Vec<Dim>& vector) const { return -vector.dot(world.down()); }
};

/// Why one sleeping body wakes.
struct Wake {
  SleepCause cause = SleepCause::momentum;
  bool before_impact = false;  // the impact is still to come: the body is expected to move
};

/// The sleeping bodies to wake after a step. Filled by try_emplace(): the first entry of a body stays.
using WakeList = std::map<BodyIndex, Wake>;

/// What the rules change after a step. Each rule adds to what the rules before it have put in.
template <int Dim>
struct RuleOutput {
  WakeList wakes;
  std::vector<VelocityChange<Dim>> velocities;  // ascending by body, each once; of bodies awake or about to wake

  /// The entry of a body, to be changed; a new one begins with the body's velocity in `states`. Valid until the next
  /// call.
  VelocityChange<Dim>& velocity_of(BodyIndex body, const BodyStates<Dim>& states);
  void clear();
};

}  // namespace talus

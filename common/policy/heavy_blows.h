#pragma once
// Blows that set many bodies in motion at once.

#include <cstdint>
#include <vector>

#include "common/pile/pile.h"
#include "common/policy/adaptive_params.h"
#include "common/world/world.h"

namespace talus {

/// A blow that is passed on from body to body lags behind one that drives a whole pile before it. So a body with that
/// much momentum wakes whom it will reach before it arrives, and around them as many as it could set in motion.
template <int Dim>
class HeavyBlows {
 public:
  /// `typical` gives D and the mass of a body.
  HeavyBlows(const AdaptiveParams& params, const TypicalBody& typical, const WorldDescription<Dim>& world);

  /// Appends sleepers to wake, each once, ascending. To be called once a step. Costs O(awake), and a look around each
  /// body whose momentum is large enough.
  void update(const World<Dim>& world, std::vector<BodyIndex>& hit);

 private:
  void foresee(const World<Dim>& world, BodyIndex body, std::vector<BodyIndex>& hit);
  const Shape<Dim>& shape_of(const BodyStates<Dim>& states, BodyIndex body) const {
    return shapes_[static_cast<std::size_t>(states.shape[static_cast<std::size_t>(body)])];
  }

  double wake_speed_;  // [m/s]
  double many_;        // mass of the bodies that count as many [kg]
  double dt_;
  std::vector<Shape<Dim>> shapes_;
  std::vector<BodyIndex> ring_;        // scratch
  std::vector<BodyIndex> next_;        // scratch
  std::vector<std::uint8_t> reached_;  // [body] scratch, all 0 between calls
};

}  // namespace talus

#include "common/solver/pair_resistance.h"

#include <optional>

#include "common/world/world_description.h"

namespace talus {

template <int Dim>
PairResistance<Dim>::PairResistance(std::span<const Shape<Dim>> shapes) {
  for (const Shape<Dim>& shape : shapes) {
    arms_.push_back(static_cast<float>(rolling_arm(shape)));
    reaches_.push_back(static_cast<float>(bounding_radius(shape)));
    rolls_ = rolls_ || arms_.back() > 0.0F;
  }
}

template <int Dim>
void PairResistance<Dim>::add_to(ContactPoint<Dim>& point, const BodyStates<Dim>& states, BodyIndex a,
                                 BodyIndex b) const {
  if (!active(states)) return;
  const auto of_pair = [&](const std::vector<float>& lengths) {
    const auto of = [&](BodyIndex side) {
      return side >= 0 ? std::optional<double>(lengths[states.shape[side]]) : std::nullopt;
    };
    return static_cast<float>(arm_of_pair(of(a), of(b)));
  };
  if (rolls_) point.rolling_arm = of_pair(arms_);
  if (const float grip = grip_between(states, a, b); grip > 0.0F) point.hold(grip, of_pair(reaches_));
}

template class PairResistance<2>;
template class PairResistance<3>;

}  // namespace talus

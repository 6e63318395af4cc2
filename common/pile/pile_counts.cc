#include "common/pile/pile_counts.h"

#include <cmath>

namespace talus {

template <int Dim>
CountedAs<Dim> counted_as(const Pile<Dim>& pile, const BodyStates<Dim>& states, BodyIndex body) {
  CountedAs<Dim> now;
  const Vec<Dim>& position = states.pose[body].position;
  now.layer = static_cast<std::int16_t>(pile.layer_of(position));
  now.asleep = states.asleep[body] != 0;
  if (now.layer < 0) return now;
  for (std::size_t axis = 0; axis < now.at.size(); ++axis) {
    const double steps = position[static_cast<Eigen::Index>(axis)] * CountedAs<Dim>::steps_per_metre;
    now.at[axis] = std::llround(steps);
  }
  return now;
}

template <int Dim>
void PileCounts<Dim>::clear(Pile<Dim>& pile, std::size_t bodies) {
  for (Layer& layer : pile.layers) layer.count = layer.sleeping = 0;
  counted_.assign(bodies, {});
  sum_ = {};
  bodies_ = 0;
}

template <int Dim>
void PileCounts<Dim>::count(Pile<Dim>& pile, BodyIndex body, const CountedAs<Dim>& now) {
  CountedAs<Dim>& kept = counted_[body];
  add(pile, kept, -1);
  add(pile, now, +1);
  kept = now;
}

template <int Dim>
void PileCounts<Dim>::add(Pile<Dim>& pile, const CountedAs<Dim>& counted, int sign) {
  if (counted.layer < 0) return;
  Layer& layer = pile.layers[counted.layer];
  layer.count += sign;
  layer.sleeping += counted.asleep ? sign : 0;
  bodies_ += sign;
  for (std::size_t axis = 0; axis < counted.at.size(); ++axis) sum_[axis] += sign * counted.at[axis];
}

template CountedAs<2> counted_as(const Pile<2>&, const BodyStates<2>&, BodyIndex);
template CountedAs<3> counted_as(const Pile<3>&, const BodyStates<3>&, BodyIndex);
template class PileCounts<2>;
template class PileCounts<3>;

}  // namespace talus

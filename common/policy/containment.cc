#include "common/policy/containment.h"

#include <algorithm>

namespace talus {

template <int Dim>
std::optional<double> wall_between(std::span<const Pile<Dim>> piles, const Vec<Dim>& a, const Vec<Dim>& b) {
  std::optional<double> highest;
  for (const Pile<Dim>& pile : piles) {
    if (!pile.boundary) continue;
    const auto within = [&](const Vec<Dim>& place) {
      return pile.boundary->gauge(horizontal<Dim>(Vec<Dim>(place - pile.centre))) <= 1.0;
    };
    const double rim = height<Dim>(pile.centre) + pile.boundary->rim;
    if (within(a) != within(b)) highest = std::max(highest.value_or(rim), rim);
  }
  return highest;
}

template <int Dim>
double slope_held(std::span<const Pile<Dim>> piles, const Vec<Dim>& place) {
  const int pile = nearest_pile(piles, place);
  return pile >= 0 && piles[static_cast<std::size_t>(pile)].held ? piles[static_cast<std::size_t>(pile)].alpha : 0.0;
}

template std::optional<double> wall_between(std::span<const Pile<2>>, const Vec<2>&, const Vec<2>&);
template std::optional<double> wall_between(std::span<const Pile<3>>, const Vec<3>&, const Vec<3>&);
template double slope_held(std::span<const Pile<2>>, const Vec<2>&);
template double slope_held(std::span<const Pile<3>>, const Vec<3>&);

}  // namespace talus

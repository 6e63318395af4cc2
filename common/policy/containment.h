#pragma once
// What keeps heaps from sliding other than themselves.

#include <optional>
#include <span>

#include "common/pile/pile.h"

namespace talus {

/// Height [m] of the highest wall of a pile between two places, of which only the horizontal parts count; none where
/// nothing parts them.
template <int Dim>
std::optional<double> wall_between(std::span<const Pile<Dim>> piles, const Vec<Dim>& a, const Vec<Dim>& b);

/// Slope [rad] to which the pile is held that a place belongs to; 0 where none is.
template <int Dim>
double slope_held(std::span<const Pile<Dim>> piles, const Vec<Dim>& place);

}  // namespace talus

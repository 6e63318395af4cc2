#pragma once
// Bodies that cannot be seen from outside of a pile.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/shape/shape.h"
#include "common/world/body.h"

namespace talus {

/// From so many bodies on some are hidden; below, all are drawn in no time.
inline constexpr int fewest_to_hide = 20'000;

/// Of each body, 1 where it is hidden: it sleeps, and so many bodies sleep around it that no line of sight reaches it.
/// Space is cut into cells as wide as the largest extent of a shape; a cell in which the centre of a sleeping body lies
/// is full, and so is every cell below `ground` [m], where there is one. A body is hidden where its cell and all cells
/// up to two away from it, edges and corners included, are full: so two cells lie between it and any place without
/// bodies, inside the pile or outside. In 2D none is hidden.
template <int Dim>
std::vector<std::uint8_t> hidden_bodies(std::span<const Shape<Dim>> shapes, const BodyStates<Dim>& states,
                                        std::optional<double> ground);

}  // namespace talus

#pragma once
// Who of those at rest is borne by ground, sleepers and one another.

#include <span>
#include <vector>

#include "common/world/world.h"

namespace talus {

/// Keeps of `candidates` (awake, ascending) those that may sleep as far as the contacts tell: at least half of a body's
/// weight is borne by ground, obstacles, sleepers or others that are kept, and at most `awake_share` of it by bodies
/// that stay awake. `weights` [N s], by shape, are over one step; without gravity they are zero, and nobody needs to be
/// borne.
///
/// Contact forces of one step tell the vertical share of each partner; that they balance is known from the body's rest.
template <int Dim>
void keep_borne(std::span<const Contact<Dim>> contacts, const BodyStates<Dim>& states, std::span<const double> weights,
                double awake_share, std::vector<BodyIndex>& candidates);

}  // namespace talus

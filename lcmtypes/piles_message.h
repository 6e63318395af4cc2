#pragma once
// talus_piles: the piles of one step with their layers.

#include <span>
#include <string_view>
#include <vector>

#include "common/pile/pile.h"
#include "lcmtypes/channels.h"

namespace talus {

/// One message at least, also where there is no pile yet.
std::vector<talus_lcm::talus_piles> to_piles(std::span<const Pile<3>> piles);

/// The pile of a message that decode() took; that of a plane scene lies in y = 0.
Pile<3> pile_of(const talus_lcm::talus_pile& message);

/// The first value that is out of its range, or nothing (see decode()).
std::string_view range_fault(const talus_lcm::talus_piles& message);

}  // namespace talus

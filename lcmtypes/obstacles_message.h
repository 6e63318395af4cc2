#pragma once
// talus_obstacles: poses of the obstacles that move.

#include <span>
#include <string_view>
#include <vector>

#include "common/world/motion.h"
#include "lcmtypes/channels.h"

namespace talus {

/// Empty if there are no poses.
template <int Dim>
std::vector<talus_lcm::talus_obstacles> to_obstacles(std::span<const ObstaclePose<Dim>> poses);

/// The first value that is out of its range, or nothing (see decode()).
std::string_view range_fault(const talus_lcm::talus_obstacles& message);

}  // namespace talus

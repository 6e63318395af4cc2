#pragma once

#include <string_view>

#include "lcmtypes/channels.h"

namespace talus {

/// The first value found that is out of its range, or nothing. Numbers are finite and booleans 0 or 1 (layout.h).
std::string_view range_fault(const talus_lcm::talus_run_v1& message);
std::string_view range_fault(const talus_lcm::talus_piles_v1& message);
std::string_view range_fault(const talus_lcm::talus_sleep_v1& message);
std::string_view range_fault(const talus_lcm::talus_stats_v1& message);
std::string_view range_fault(const talus_lcm::talus_stats_v2& message);
std::string_view range_fault(const talus_lcm::talus_bodies_v1& message);
std::string_view range_fault(const talus_lcm::talus_shapes_v1& message);

}  // namespace talus

#pragma once
// Losses, faults and warnings of the runs that a monitor receives.

#include <string>
#include <vector>

#include "tools/monitor/heard.h"

namespace talus {

/// Warnings of a run, loss, many bodies that woke at once, silence, and faults of the network; one line each.
std::vector<std::string> alerts_of(const Heard& heard);

}  // namespace talus

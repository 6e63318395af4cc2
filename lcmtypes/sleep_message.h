#pragma once
// talus_sleep: bodies that fell asleep or woke in one step.

#include <span>
#include <string_view>
#include <vector>

#include "common/policy/sleep_event.h"
#include "lcmtypes/channels.h"

namespace talus {

/// No message where there are no events.
std::vector<talus_lcm::talus_sleep> to_sleep(std::span<const SleepEvent> events);

/// The events of a message that has passed decode().
std::vector<SleepEvent> events_of(const talus_lcm::talus_sleep& message);

/// The first value that is out of its range, or nothing (see decode()).
std::string_view range_fault(const talus_lcm::talus_sleep& message);

}  // namespace talus

#pragma once
// talus_event: an event of the scene.

#include <string_view>
#include <vector>

#include "common/policy/frame.h"
#include "common/scene/scene.h"
#include "lcmtypes/channels.h"

namespace talus {

/// All events of a scene, none of which has happened.
template <int Dim>
std::vector<talus_lcm::talus_event> to_events(const Scene<Dim>& scene);

/// Says that the event has happened, just before the frame's step of `dt` [s].
template <int Dim>
void set_happened(const Frame<Dim>& frame, double dt, talus_lcm::talus_event& message);

/// The first value that is out of its range, or nothing (see decode()).
std::string_view range_fault(const talus_lcm::talus_event& message);

}  // namespace talus

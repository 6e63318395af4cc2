#pragma once
// talus_instruments: gates, regions and loads.

#include <string_view>
#include <vector>

#include "common/measure/instrument_meters.h"
#include "lcmtypes/channels.h"

namespace talus {

/// What was measured. `scene`: names the obstacles.
template <int Dim>
std::vector<talus_lcm::talus_instruments> to_instruments(const InstrumentMeters<Dim>& meters,
                                                         const std::vector<ObstacleName>& obstacles);

/// The first value that is out of its range, or nothing (see decode()).
std::string_view range_fault(const talus_lcm::talus_instruments& message);

}  // namespace talus

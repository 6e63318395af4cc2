#pragma once

#include <cstdint>
#include <string>

#include "tools/monitor/faults.h"
#include "tools/monitor/run_view.h"

namespace talus {

/// A run as one JSON object in one line, for programs. `faults` are those of the whole network.
std::string json_line(std::int64_t run_id, const RunView& view, const Faults& faults);

/// The faults as the object `faults` of an object without `run`.
std::string json_line(const Faults& faults);

}  // namespace talus

#pragma once

#include <cstdint>
#include <string>

#include "tools/monitor/run_view.h"

namespace talus {

/// A run as one JSON object in one line, for programs. `undecodable` is that of the whole network.
std::string json_line(std::int64_t run_id, const RunView& view, std::int64_t undecodable);

}  // namespace talus

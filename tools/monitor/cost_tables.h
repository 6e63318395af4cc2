#pragma once
// What a step and the messages of a run cost, on the monitor's screen.

#include <vector>

#include "tools/monitor/heard.h"
#include "tools/monitor/sheet.h"

namespace talus {

/// Milliseconds per step of each phase.
void draw_phases(const RunView& view, const Area& area);

/// Those of the table.
std::vector<Channel> channels_of(const RunView& view);

/// Messages and bytes a second, lost and undecodable messages of each channel.
void draw_channels(const Heard& heard, const HeardRun& run, const Area& area);

}  // namespace talus

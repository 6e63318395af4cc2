#pragma once
// Awake and sleeping bodies over time on the monitor's screen.

#include "tools/monitor/run_view.h"
#include "tools/monitor/sheet.h"

namespace talus {

/// Two graphs side by side.
void draw_counts(const RunView& view, const Area& area);

}  // namespace talus

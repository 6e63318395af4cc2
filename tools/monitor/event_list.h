#pragma once
// The sleep events of a run on the monitor's screen.

#include "tools/monitor/run_view.h"
#include "tools/monitor/sheet.h"

namespace talus {

/// Number of filters for the run's events: all, bodies that woke, bodies that fell asleep, and each cause so far.
int event_filters(const RunView& view);

/// The newest events that pass the filter, newest first, from row `first` of them on. `filter`: any number >= 0, modulo
/// event_filters().
void draw_events(const RunView& view, int filter, int first, const Area& area);

/// Number of events of each cause.
void draw_causes(const RunView& view, const Area& area);

}  // namespace talus

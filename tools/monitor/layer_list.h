#pragma once
// The layers of a pile on the monitor's screen.

#include "tools/monitor/run_view.h"
#include "tools/monitor/sheet.h"

namespace talus {

/// Density, bodies and capacity of each layer, bottom last; neighbours share a row where there are too many.
/// `pile_place`: any number >= 0, modulo the number of piles.
void draw_layers(const RunView& view, int pile_place, const Area& area);

}  // namespace talus

#pragma once
// The parts of the full-screen monitor, each drawn into an area of its own.

#include <string>
#include <vector>

#include "tools/monitor/heard.h"
#include "tools/monitor/sheet.h"

namespace talus {

/// Awake and sleeping bodies over time: two graphs side by side.
void draw_counts(const RunView& view, const Area& area);

/// Density, bodies and capacity of each layer of a pile, bottom last; neighbours share a row where there are too many.
/// `pile_place`: any number >= 0, modulo the number of piles.
void draw_layers(const RunView& view, int pile_place, const Area& area);

/// Number of filters for the run's sleep events: all, bodies that woke, bodies that fell asleep, and each cause so far.
int event_filters(const RunView& view);
/// The newest events that pass the filter, newest first, from row `first` of them on. `filter`: any number >= 0, modulo
/// event_filters().
void draw_events(const RunView& view, int filter, int first, const Area& area);
/// Number of events of each cause.
void draw_causes(const RunView& view, const Area& area);

/// Rows that draw_instruments() takes; 0: the run measures nothing.
int instrument_rows(const RunView& view);
/// The newest reading of each gate, region and load, from number `first` on. What a gate counts is in bodies, a packing
/// in per cent, a load the force along each axis.
void draw_instruments(const RunView& view, int first, const Area& area);

/// Milliseconds per step of each phase.
void draw_phases(const RunView& view, const Area& area);
/// The channels of draw_channels().
std::vector<Channel> channels_of(const RunView& view);
/// Messages and bytes a second, lost and undecodable messages of each channel.
void draw_channels(const Heard& heard, const HeardRun& run, const Area& area);

/// Warnings of a run, loss, many bodies that woke at once, silence, and faults of the network; one line each.
std::vector<std::string> alerts_of(const Heard& heard);

}  // namespace talus

#pragma once
// What events of a scene have made of it.

#include <span>
#include <string>

#include "common/scene/scene.h"
#include "common/world/done_event.h"

namespace talus {

/// One line, as "remove obstacle gate" or "gravity [0, -5]".
template <int Dim>
std::string event_text(const Scene<Dim>& scene, int number);

/// The world as it is at a time [s], after events that happened by then: obstacles where they are, without those
/// removed, and gravity.
template <int Dim>
WorldDescription<Dim> world_at(const Scene<Dim>& scene, std::span<const DoneEvent> done, double time);

/// Whether gravity, or an obstacle that events have left there, moves by plan after a time [s].
template <int Dim>
bool still_moves(const Scene<Dim>& scene, std::span<const DoneEvent> done, double time);

}  // namespace talus

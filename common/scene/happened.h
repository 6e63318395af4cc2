#pragma once
// What events of a scene have made of it.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "common/world/done_event.h"

namespace talus {

/// One line, as "remove obstacle gate" or "gravity [0, -5]".
template <int Dim>
std::string event_text(const Scene<Dim>& scene, int number);
/// With the number of bodies on which it acted, as "kick some bodies: 3".
template <int Dim>
std::string event_text(const Scene<Dim>& scene, const DoneEvent& event);
/// A line for each event that found no body to act on.
template <int Dim>
std::vector<std::string> idle_event_lines(const Scene<Dim>& scene, std::span<const DoneEvent> done);

/// By obstacle: 1 if events that happened by a time [s] have removed it, or one that has not happened will add it.
template <int Dim>
std::vector<std::uint8_t> absent_obstacles(const Scene<Dim>& scene, std::span<const DoneEvent> done, double time);

/// The world as it is at a time [s], after events that happened by then: obstacles where they are, without those
/// that are absent, and gravity.
template <int Dim>
WorldDescription<Dim> world_at(const Scene<Dim>& scene, std::span<const DoneEvent> done, double time);

/// The policy at a time [s], after events that happened by then.
template <int Dim>
PolicyParams policy_at(const Scene<Dim>& scene, std::span<const DoneEvent> done, double time);

/// Whether bodies are still driven after a time [s]: gravity or an obstacle that is present moves by plan, or the force
/// of an event acts.
template <int Dim>
bool still_driven(const Scene<Dim>& scene, std::span<const DoneEvent> done, double time);

}  // namespace talus

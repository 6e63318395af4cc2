#pragma once
// How many bodies the events of a run act on.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/policy/observer.h"
#include "common/scene/scene.h"
#include "common/simulation/simulation.h"

namespace talus {

/// By number of the event: the bodies that it acted on. None before it happens, and of one that does not choose bodies,
/// as `gravity`.
using EventBodies = std::vector<std::optional<int>>;

/// event_text() with the number of bodies where there is one.
template <int Dim>
std::string event_text(const Scene<Dim>& scene, int number, const EventBodies& bodies);

template <int Dim>
class EventHits final : public Observer<Dim> {
 public:
  EventHits(const Scene<Dim>& scene, const Simulation<Dim>& simulation);
  void on_start(const World<Dim>& world) override;
  void on_frame(const Frame<Dim>& frame) override;

  const EventBodies& bodies() const { return bodies_; }
  /// A line for each event that found no body.
  std::vector<std::string> idle_lines() const;

 private:
  const Scene<Dim>& scene_;
  const Simulation<Dim>& simulation_;
  std::size_t seen_ = 0;               // of the events that have happened
  std::vector<std::uint8_t> removed_;  // of the bodies that were there before the step
  EventBodies bodies_;
};

}  // namespace talus

#pragma once

#include <span>
#include <vector>

#include "common/pile/pile.h"
#include "common/scene/scene.h"

namespace talus {

/// A time that is a whole number of steps is not a step late by rounding [s].
inline constexpr double time_rounding = 1e-9;

/// Finds which events of a scene are due. Each happens once.
template <int Dim>
class EventClock {
 public:
  explicit EventClock(const std::vector<Event<Dim>>& events);

  /// Before a step from `time` [s] on, after so many bodies have appeared, in a world at rest or not, with its piles:
  /// those that are due, in the order of the file; of those that wait for rest only the first.
  std::span<const int> update(double time, int bodies, bool at_rest, std::span<const Pile<Dim>> piles);
  /// The same until the next update.
  std::span<const int> due() const { return due_; }

  /// Whether an event waits for rest, for the density of a layer, and for rest or a time.
  bool waits_for_rest() const;
  bool waits_for_layers() const;
  bool waits() const;

 private:
  struct Condition {
    int number = 0;
    std::optional<double> time;
    bool rest = false;
    std::optional<double> density = {};
    int pile = 0;
    std::int64_t bodies = 0;
  };
  std::vector<Condition> waiting_;
  std::vector<int> due_;
};

}  // namespace talus

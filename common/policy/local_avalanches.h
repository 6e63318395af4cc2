#pragma once
// Heaps that grow too steep on sleepers.

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "common/pile/pile.h"
#include "common/policy/adaptive_params.h"
#include "common/simulation/sleep_event.h"
#include "common/world/world.h"

namespace talus {

/// The avalanche of section 3.4, only where a heap may slide. A sleeper bears any load and does not creep, so what is
/// heaped on sleepers grows steeper than what is awake. Space is cut into upright columns. When one holds
/// `avalanche_growth` times the sleepers of its last look, and the highest of them lies steeply above those of a column
/// beside it, it wakes with all columns around it, which counts as a look at each: what can slide slides, the rest
/// sleeps again a moment later. Where more are awake than asleep, blows ask enough. While no awake body touches
/// another, columns are asked from `avalanche_growth_quiet` on, all at once, so that no heap comes to rest unasked.
template <int Dim>
class LocalAvalanches {
 public:
  /// `extent` is D [m], `ground` its height [m].
  LocalAvalanches(const AdaptiveParams& params, double extent, double ground);

  /// Notes who is going to sleep and who wakes; both lie where they will sleep or slept. Costs O(events).
  void note(const BodyStates<Dim>& states, std::span<const SleepEvent> falling_asleep,
            std::span<const SleepEvent> waking);

  /// Whether columns have grown since all was `quiet`.
  bool waiting() const { return !unasked_.empty(); }

  /// Appends the sleepers of columns that may slide, each once, ascending. `piles` tell where walls are, over which
  /// only what stands above their rim slides, and which slopes are held; `quiet`, whether no awake body touches another
  /// body. Costs O(columns that grew); one that may slide, a query of its sleepers.
  void update(const World<Dim>& world, std::span<const Pile<Dim>> piles, bool quiet, std::vector<BodyIndex>& sliding);

 private:
  using Cell = std::array<int, Dim - 1>;
  struct Column {
    int sleepers = 0;   // as events tell; a body taken away by hand is found missing at the next look
    int looked_at = 8;  // sleepers at the last look; fewer make no heap

    void note_look(std::size_t found) { looked_at = std::max(looked_at, static_cast<int>(found)); }
  };
  /// The sleepers of a column as they lie.
  struct Stack {
    std::vector<BodyIndex> bodies;
    std::optional<double> top;  // highest centre of mass [m]; none: empty
  };

  Cell cell_of(const Vec<Dim>& position) const;
  void ask(const World<Dim>& world, std::span<const Pile<Dim>> piles, const Cell& cell, double enough, bool quiet,
           std::vector<BodyIndex>& sliding);
  bool mostly_awake() const;
  bool is_steep(std::span<const Pile<Dim>> piles, const Cell& cell) const;
  void gather(const World<Dim>& world, const Cell& cell);
  Vec<Dim> middle_of(const Cell& cell) const;

  double extent_;        // D [m]
  double width_;         // of a column [m]
  double growth_;        // since the last look
  double growth_quiet_;  // while all is quiet
  double angle_;         // slope between columns from which they may slide [rad]
  double ground_;
  std::map<Cell, Column> columns_;
  std::vector<Cell> grown_;              // since the last update
  std::set<Cell> unasked_;               // that grew since all was quiet
  std::map<Cell, Stack> neighbourhood_;  // scratch: of the column looked at, and those around it
  std::vector<BodyIndex> near_;          // scratch
  std::size_t awake_near_ = 0;           // scratch: in and around the column looked at
};

}  // namespace talus

#pragma once
// Heaps of sleeping bodies that grow too steep.

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "common/policy/rest/rule.h"
#include "common/policy/wake_rules/sleep_ledger.h"

namespace talus {

/// The avalanche of section 3.4, limited to the part of a heap that may slide. A sleeping body carries any load and
/// does not creep, so a heap on sleeping bodies grows steeper than one of awake bodies.
///
/// Space is cut into vertical columns. A column is checked when it holds `avalanche_growth` times the sleeping bodies
/// of its last check. If its highest body lies above that of a neighbouring column by a slope of `avalanche_angle`, the
/// column wakes with all columns around it, which counts as a check of each. Bodies that can slide do so, the others
/// sleep again a moment later. Where more bodies are awake than asleep nothing wakes, since impacts wake enough.
/// Heaps that have come to rest are checked by StabilityChecks.
template <int Dim>
class LocalAvalanches {
 public:
  explicit LocalAvalanches(const RuleSetup<Dim>& setup);

  /// A body fell asleep at `position` [m].
  void note_asleep(const Vec<Dim>& position) { grown_.push_back(grid_.cell_of(position)); }

  /// Wakes the columns that may slide. Over the wall of a pile only what lies above its rim can slide. Costs
  /// O(columns that grew), and a box query for each that is checked.
  void update(const RuleInput<Dim>& in, const SleepLedger<Dim>& sleepers, RuleOutput<Dim>& out);

 private:
  using Columns = typename SleepLedger<Dim>::Columns;
  using Cell = typename Columns::Cell;
  struct Column {
    /// Sleeping bodies at the last check. The initial value is the least from which bodies make a heap (chosen, not
    /// measured): in a column 4 D wide fewer lie in about one layer.
    int last_checked = 8;

    void note_check(std::size_t found) { last_checked = std::max(last_checked, static_cast<int>(found)); }
  };
  /// The sleeping bodies of a column.
  struct Stack {
    std::vector<BodyIndex> bodies;
    std::optional<double> top;  // height of the highest centre of mass [m]; none if empty
  };

  void check_column(const RuleInput<Dim>& in, const Cell& cell, RuleOutput<Dim>& out);
  void collect_neighbourhood(const RuleInput<Dim>& in, const Cell& cell);
  bool mostly_awake() const;
  bool is_steep(std::span<const Pile<Dim>> piles, const Cell& cell) const;

  Columns grid_;
  double growth_;  // of a column until it is checked, as a factor
  double angle_;   // slope between columns from which they may slide [rad]
  double ground_;  // [m]
  std::map<Cell, Column> columns_;
  std::vector<Cell> grown_;              // since the last update
  std::map<Cell, Stack> neighbourhood_;  // scratch: the column that is checked and those around it
  std::vector<BodyIndex> near_;          // scratch
  std::size_t awake_near_ = 0;           // scratch: awake bodies in the neighbourhood
};

}  // namespace talus

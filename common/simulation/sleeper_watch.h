#pragma once

#include <functional>
#include <optional>
#include <span>

#include "common/policy/observer.h"
#include "common/simulation/overlap_watch.h"
#include "common/simulation/passing_watch.h"

namespace talus {

/// Watches a world that another program simulates, see PileSleeper::observe(). It warns of bodies that pass through
/// each other within a step, that overlap deeply, or that lie outside of the range of positions. It does not check
/// energy, since the program may push its bodies. Costs O(awake) a step, and O(contacts) in steps in which overlap is
/// sampled.
template <int Dim>
class SleeperWatch final : public Observer<Dim> {
 public:
  /// Called in the step in which a kind of fault is seen for the first time; text by advice().
  using Report = std::function<void(const Warning&)>;
  explicit SleeperWatch(Report report = {}) : report_(std::move(report)) {}

  bool needs_contacts() const override { return overlap_ && overlap_->due(step_ + 1); }
  void on_start(const World<Dim>& world) override;
  void on_motion(const World<Dim>& world, double time) override;
  void on_frame(const Frame<Dim>& frame) override;
  std::span<const Warning> warnings() const override { return warnings_.all(); }

 private:
  Report report_;
  std::int64_t step_ = 0;
  std::int64_t form_ = -1;  // of the world that passing_ is of
  double extent_ = 0.0;     // that overlap_ is of [m]
  std::optional<PassingWatch<Dim>> passing_;
  std::optional<OverlapWatch<Dim>> overlap_;
  WarningList warnings_;
  std::size_t reported_ = 0;
};

}  // namespace talus

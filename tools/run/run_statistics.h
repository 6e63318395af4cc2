#pragma once
// What a run cost and what it left, for summary.json and the closing lines.

#include <deque>

#include "common/policy/observer.h"
#include "common/scene/scene.h"

namespace talus {

/// Sleeping bodies, without removed ones.
template <int Dim>
std::int64_t bodies_asleep(const World<Dim>& world) {
  return world.states().size() - world.removals() - std::ssize(world.awake());
}

/// Sums over the steps of a run.
template <int Dim>
class RunStatistics final : public Observer<Dim> {
 public:
  void on_frame(const Frame<Dim>& frame) override;

  std::int64_t steps() const { return steps_; }
  const PhaseTimes& sum() const { return sum_; }  // over all steps [s]
  /// Simulation without observers, [ms] per step: over all steps, and over the last hundred.
  double mean_step_ms() const;
  double last_step_ms() const;
  double mean_awake() const { return steps_ > 0 ? static_cast<double>(awake_) / static_cast<double>(steps_) : 0.0; }
  /// Share of all body-steps that the engine did not simulate.
  double work_skipped() const {
    return body_steps_ > 0 ? 1.0 - static_cast<double>(awake_) / static_cast<double>(body_steps_) : 0.0;
  }
  std::int64_t slept() const { return slept_; }
  std::int64_t woken() const { return woken_; }

 private:
  PhaseTimes sum_;
  std::deque<double> last_;  // [s] of the last hundred steps
  std::int64_t steps_ = 0;
  std::int64_t awake_ = 0;       // body-steps
  std::int64_t body_steps_ = 0;  // asleep or awake
  std::int64_t slept_ = 0;
  std::int64_t woken_ = 0;
};

}  // namespace talus

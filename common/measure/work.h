#pragma once
// How many body-steps a run skipped, and how many it could have skipped.

#include <cstdint>
#include <span>

#include "common/measure/trajectory.h"

namespace talus {

/// Counts of a run so far.
struct Work {
  std::int64_t body_steps = 0;  // bodies in the world, summed over steps
  std::int64_t simulated = 0;   // of these awake
  std::int64_t contacts = 0;    // contact points of awake bodies, summed over steps; 0 unless counted

  /// Share of body-steps not simulated; 0 before the first step.
  double skipped() const {
    return body_steps > 0 ? 1.0 - static_cast<double>(simulated) / static_cast<double>(body_steps) : 0.0;
  }
};

/// Share of the contact points of a full run that `run` did not solve. Negative where it had more.
double contacts_skipped(const Work& run, const Work& full);

/// Counts awake bodies and contacts during a simulation. With `contacts` each step records its contacts, which takes
/// time: leave it off in a run that is timed. A body counts as awake if it is awake at the end of the step, after the
/// policy has put bodies to sleep.
template <int Dim>
class WorkCounter : public Observer<Dim> {
 public:
  explicit WorkCounter(bool contacts) : count_contacts_(contacts) {}
  bool needs_contacts() const override { return count_contacts_; }
  void on_frame(const Frame<Dim>& frame) override;
  const Work& work() const { return work_; }

 private:
  bool count_contacts_;
  Work work_;
};

/// How many bodies of a full run move. A policy that knew the future and simulated only these would save `ratio`. It is
/// no bound: a run under a policy creeps less than the full run, so its own hindsight may be higher.
struct Hindsight {
  /// Share of body-frames at which the body moves far within the window.
  double share = 0.0;
  /// 1 / share; infinite if nothing moves.
  double ratio = 0.0;
};

/// From a run without sleeping: a body-frame counts if within the next `window` [s] the body is at some frame more than
/// `x` D away from where it is. Frames from `first` to before `last` whose window lies within the run; `last` < 0: all.
template <int Dim>
Hindsight hindsight(const Trajectory<Dim>& full, std::span<const double> extents, double x, double window = 0.5,
                    int first = 0, int last = -1);

}  // namespace talus

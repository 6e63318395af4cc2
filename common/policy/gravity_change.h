#pragma once
// What a change of gravity does to sleeping bodies.

#include <optional>

#include "common/world/gravity_units.h"
#include "common/world/world_description.h"

namespace talus {

/// Sleeping bodies do not feel that gravity changes. Once it has by more than a little, all must wake, and stay awake
/// until they have had time to begin to move.
template <int Dim>
class GravityChange {
 public:
  /// `gravity`: at the start [m/s^2]. `extent`: of the typical body, D [m].
  GravityChange(const Vec<Dim>& gravity, double extent) : of_sleepers_(gravity), extent_(extent) {}

  /// Whether all bodies must wake in the present gravity.
  bool wakes(const Vec<Dim>& now) const { return !same_gravity<Dim>(now, of_sleepers_); }
  /// All bodies woke for the gravity `now` at `time` [s].
  void note_wake(const Vec<Dim>& now, double time) {
    of_sleepers_ = now;
    woken_at_ = time;
  }
  /// Whether bodies must stay awake at `time` [s].
  bool keeps_awake(double time) const {
    return woken_at_ && time - *woken_at_ < awake_after_gravity * time_unit(extent_, of_sleepers_.norm());
  }

 private:
  /// In sqrt(D/g): how long a body stays awake after gravity woke it. At an acceleration of a hundredth of it a body
  /// has then moved by 0.02 D and is so fast that it counts as moving.
  static constexpr double awake_after_gravity = 2.0;

  Vec<Dim> of_sleepers_;  // when all bodies were last woken for it [m/s^2]
  double extent_;
  std::optional<double> woken_at_;  // [s]
};

}  // namespace talus

#pragma once
// Control of a pile's slope by the grip of its bodies.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/pile/pile_set.h"
#include "common/scene/scene.h"
#include "common/world/world.h"

namespace talus {

/// Holds each pile with `control_slope` at its slope alpha (section 3.1: "set by the user"). Its bodies get a grip
/// (World::set_grip()), by a proportional-derivative controller of the measured slope s:
///
///     grip = clamp(k (alpha - s - T min(ds/dt, 0)), 0, max)
///
/// with T the time for which the pile's sinking is foreseen. These are forces: they hold the pile under every policy,
/// and also once all of its bodies wake.
template <int Dim>
class SlopeControl {
 public:
  explicit SlopeControl(const Scene<Dim>& scene);

  /// Whether any pile is controlled.
  bool active() const { return active_; }

  /// After step number `step`. A body belongs to its nearest pile. One that sleeps keeps its grip; returned are those
  /// to wake, since their grip keeps their pile too steep, ascending, valid until the next call. Costs O(all bodies) at
  /// each measurement, and nothing while all bodies sleep.
  std::span<const BodyIndex> update(World<Dim>& world, const PileSet<Dim>& piles, std::int64_t step);

 private:
  /// Of one pile.
  struct Control {
    float grip = 0.0F;
    std::optional<double> slope;      // as last measured [rad]
    bool too_steep = false;           // without a grip: sleeping bodies that still have one must wake
    std::vector<Vec<Dim>> positions;  // scratch: of its bodies, relative to the middle of its base [m]
  };

  void find_held(const BodyStates<Dim>& states, const PileSet<Dim>& piles);
  void measure(const BodyStates<Dim>& states, const PileSet<Dim>& piles);
  void update_grip(const Pile<Dim>& pile, Control& control, double interval);

  bool active_;
  double extent_;                  // D [m]
  std::int64_t measured_ = 0;      // number of the step of the last measurement
  std::vector<Control> controls_;  // [pile]
  std::vector<BodyIndex> held_;    // scratch: to wake
};

}  // namespace talus

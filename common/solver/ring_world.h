#pragma once
// World of an engine in which the common solver can solve sleeping bodies too.

#include <optional>
#include <span>
#include <vector>

#include "common/solver/ring.h"
#include "common/world/world.h"

namespace talus {

/// Implements the functions of World on the ring and on the grip of bodies.
template <int Dim>
class RingWorld : public World<Dim> {
 protected:
  using World<Dim>::World;

  std::optional<Ring<Dim>> ring_;  // none: sleeping bodies feel nothing

 private:
  /// Of the impulses in the solver [N s].
  virtual double impulse_unit() const = 0;

  void engine_set_ring(const std::optional<SleepRing>& ring) final {
    ring_.reset();
    if (ring) ring_.emplace(*ring);
  }
  void engine_set_grip(BodyIndex /*body*/, double /*grip*/) final {}  // the solver takes it from states()
  std::span<const BodyIndex> engine_stirred() const final {
    return ring_ ? ring_->stirred() : std::span<const BodyIndex>();
  }
  bool engine_feels(BodyIndex body, BodyIndex side) const final { return ring_ && ring_->touch(body, side); }
  void engine_sleeping_contacts(BodyIndex side, std::vector<Contact<Dim>>& found) const final {
    if (ring_) ring_->append_contacts(side, this->states(), impulse_unit(), found);
  }
  int engine_solved_sleepers() const final { return ring_ ? static_cast<int>(ring_->members().size()) : 0; }
};

}  // namespace talus

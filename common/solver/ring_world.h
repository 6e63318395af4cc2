#pragma once
// World of an engine in which the common solver can solve sleeping bodies too.

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

  /// Null: sleeping bodies feel nothing.
  virtual const Ring<Dim>* ring() const = 0;

 private:
  /// Of the impulses in the solver [N s].
  virtual double impulse_unit() const = 0;

  void engine_set_grip(BodyIndex /*body*/, double /*grip*/) final {}  // the solver takes it from states()
  std::span<const BodyIndex> engine_stirred() const final {
    return ring() != nullptr ? ring()->stirred() : std::span<const BodyIndex>();
  }
  bool engine_feels(BodyIndex body, BodyIndex side) const final {
    return ring() != nullptr && ring()->touch(body, side);
  }
  void engine_sleeping_contacts(BodyIndex side, std::vector<Contact<Dim>>& found) const final {
    if (ring() != nullptr) ring()->append_contacts(side, this->states(), impulse_unit(), found);
  }
  int engine_solved_sleepers() const final {
    return ring() != nullptr ? static_cast<int>(ring()->members().size()) : 0;
  }
};

}  // namespace talus

#pragma once
// What resists rolling and parting at the contact points of two bodies.

#include <span>
#include <vector>

#include "common/shape/shape.h"
#include "common/solver/contact_solver.h"
#include "common/world/body.h"

namespace talus {

/// Rolling friction of the shapes and grip of the bodies, in the contact points of all engines.
template <int Dim>
class PairResistance {
 public:
  explicit PairResistance(std::span<const Shape<Dim>> shapes);

  /// Of a shape: from the centre of mass to any point of it at most [m].
  float reach(int shape) const { return reaches_[shape]; }
  /// Whether any point resists rolling.
  bool active(const BodyStates<Dim>& states) const { return rolls_ || !states.grip.empty(); }
  /// Adds it to a point between two sides, as contacts number them, of which the surfaces' friction is set.
  void add_to(ContactPoint<Dim>& point, const BodyStates<Dim>& states, BodyIndex a, BodyIndex b) const;

 private:
  std::vector<float> arms_;     // by shape, see rolling_arm() [m]
  std::vector<float> reaches_;  // by shape
  bool rolls_ = false;          // a shape has rolling friction
};

}  // namespace talus

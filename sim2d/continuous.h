#pragma once
// Which bodies need continuous collision against sleepers.

#include <box2d/box2d.h>

#include "common/world/world_description.h"

namespace talus::box2d {

/// Spares slow bodies Box2D's search for times of impact. Between two awake bodies Box2D never searches; between an
/// awake and a static one always, and a sleeper is static: in a pile with every fourth body awake the search was half
/// of the step. A body that cannot get through a quarter of the thinnest shape within a step needs none. Ground and
/// obstacles are left as they are, so a world without sleepers runs as Box2D does by itself.
class ContinuousCollision {
 public:
  explicit ContinuousCollision(const WorldDescription<2>& description);

  /// From PostSolve of a touching contact of a sleeper, between solver and search: if its awake body is slow, leaves
  /// out all its contacts with sleepers; they are back in the next step.
  void leave_out_if_slow(b2Contact& contact) const;

 private:
  float slow_ = 0.0F;   // [m/s], of any point of a body
  float reach_ = 0.0F;  // [m], from a body's centre to any point of it, over all shapes
};

}  // namespace talus::box2d

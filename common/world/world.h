#pragma once
// The seam to a physics engine.

#include <limits>
#include <span>
#include <vector>

#include "common/world/body.h"
#include "common/world/world_description.h"

namespace talus {

/// Where the engine's time of the last step went [s]; zero where an engine cannot tell.
struct EngineTimes {
  double collide = 0.0;  // broad and narrow phase
  double solve = 0.0;    // islands, constraints, integration
  double read = 0.0;     // copying the awake bodies' states out
};

/// What an engine can move a body at. At these Box2D cuts speed and spin and Bullet the spin; up to this speed Bullet's
/// continuous collision was tried.
struct SpeedLimits {
  double speed = std::numeric_limits<double>::infinity();  // [m/s]
  double spin = std::numeric_limits<double>::infinity();   // [rad/s]
};

/// A world of rigid bodies in one engine. A new world with the same calls gives the same bits.
///
/// A frozen body is solid and immovable: bodies rest on it, nothing wakes it but thaw(), and it costs nothing per step.
/// freeze() and thaw() act at once and must not be called while step() runs. Bad input throws std::invalid_argument
/// before the engine sees it; a state that is not finite after a step throws NonFiniteState.
template <int Dim>
class World {
 public:
  virtual ~World() = default;

  /// Adds an awake body and returns its index, the number of bodies added before.
  virtual BodyIndex add(const BodyDef<Dim>& body) = 0;

  /// Takes a body out for good. Sleepers that rested on it stay asleep: waking them is the caller's decision.
  virtual void remove(BodyIndex body) = 0;

  /// Advances by dt.
  virtual void step() = 0;

  /// Sets the velocity of an awake body (a throw, a kick).
  virtual void set_velocity(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin) = 0;

  /// Everybody's state; changes with add, remove, step, freeze, thaw.
  virtual const BodyStates<Dim>& states() const = 0;

  /// Bodies awake, ascending. Their number is what a step costs.
  virtual std::span<const BodyIndex> awake() const = 0;

  /// Contact points of awake bodies in the last step, in the same order whenever the input is the same, the points of
  /// one pair side by side. Each stands once: between two awake bodies under the one with the lower index. Approach
  /// speeds are known from the step after the first call on; depths follow from the shapes and may be negative.
  /// Gathered when first asked for after a step; costs nothing otherwise.
  virtual std::span<const Contact<Dim>> contacts() = 0;

  /// Takes awake bodies out of the engine's work, at rest. Bodies already asleep are left alone.
  virtual void freeze(std::span<const BodyIndex> bodies) = 0;

  /// Makes sleeping bodies movable again, at rest. Bodies already awake are left alone.
  virtual void thaw(std::span<const BodyIndex> bodies) = 0;

  /// Appends every body, awake or asleep, whose bounding box may touch `box` (a superset), ascending.
  virtual void near(const Box<Dim>& box, std::vector<BodyIndex>& found) const = 0;

  virtual EngineTimes times() const = 0;

  /// Infinite where the engine has none.
  virtual SpeedLimits speed_limits() const { return {}; }
};

}  // namespace talus

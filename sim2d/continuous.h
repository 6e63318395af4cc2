#pragma once
// Which bodies need continuous collision, and against what.

#include <box2d/box2d.h>

#include <cmath>
#include <vector>

#include "common/world/world_description.h"

namespace talus::box2d {

/// Chooses in each step the pairs for which Box2D searches times of impact (TOI).
///
/// By itself Box2D searches between a body and what is static, never between two awake bodies, unless one is a
/// "bullet". Two convex bodies that come together in one step by more than half the sum of their least widths may each
/// be beyond the other's middle at its end, where contact pushes them on and apart: one of such a pair is a bullet for
/// that step. Where no body moves by more than half its own width in a step there is no such pair.
///
/// Between an awake body and a sleeper, which is static here, Box2D always searches: in a pile with every fourth body
/// awake that was half of the step. A body that cannot get through a quarter of the thinnest shape within a step needs
/// none. Ground and obstacles are left as they are, so a world without sleepers and without fast bodies runs as Box2D
/// does by itself.
class ContinuousCollision final : public b2ContactFilter {
 public:
  explicit ContinuousCollision(const WorldDescription<2>& description);

  /// Before a step, once Box2D has found all pairs: sweeps the body, made of this shape, if one of its pairs needs it.
  void note_body(b2Body& body, int shape) {
    if (!is_fast(body, restless_size_)) return;
    restless_ = true;
    if (is_fast(body, sizes_[shape])) sweep_if_needed(body);
  }
  /// Before a step in which an obstacle moves: it may make any body fast.
  void note_moving_obstacle() { restless_ = true; }
  /// Between the last note_body() and end_step() bodies may be swept.
  void start_step() { stepping_ = true; }
  /// After a step, before a body is destroyed: no body is swept any more.
  void end_step();

  /// From PostSolve, between solver and search, and again after each time of impact: as note_body(), for what an impact
  /// has made fast. `sleepers`: whether there are any; contacts of a slow body with them are then left out of the
  /// search, and those of one that has become fast put back.
  void note_solved(b2Contact& contact, bool sleepers);

  /// Notes a pair that Box2D finds after the solver. All pairs collide but those of images (see Image).
  bool ShouldCollide(b2Fixture* a, b2Fixture* b) override;

 private:
  /// How far a body can go in a step, as a speed of its surface.
  struct Size {
    float reach = 0.0F;  // way of its surface, at most, in a turn by one radian [m]
    float slow = 0.0F;   // [m/s]: at this speed it moves by half its least width in a step
  };
  static bool is_fast(const b2Body& body, const Size& size) {
    const float rest = size.slow - size.reach * std::abs(body.GetAngularVelocity());
    return rest < 0.0F || body.GetLinearVelocity().LengthSquared() > rest * rest;
  }
  const Size& size_of(const b2Body& body) const;
  bool is_fast(const b2Body& body) const { return is_fast(body, any_) && is_fast(body, size_of(body)); }
  float excess(const b2Body& a, const b2Body& b) const;
  bool may_pass(b2Contact& contact) const;
  bool may_pass(b2Fixture& a, b2Fixture& b) const;
  b2Transform start_of(const b2Body& body) const;
  void sweep_if_needed(b2Body& body);
  void sweep(b2Body& body);
  void weigh_sleepers(b2Contact& contact) const;
  static void search_sleepers(const b2Body& body, bool search);
  bool is_slow(const b2Body& body) const;

  std::vector<Size> sizes_;  // by shape
  Size restless_size_;       // a body that is not fast with this one has a quarter of the speed of a fast one at most
  Size any_;                 // a body that is not fast with this one is not fast with its own
  float slow_ = 0.0F;        // [m/s], of any point of a body: slower ones do not get through a sleeper
  float dt_ = 0.0F;          // [s]
  std::vector<b2Body*> swept_;
  bool stepping_ = false;
  bool restless_ = false;  // else no impact of this step makes a body fast
};

}  // namespace talus::box2d

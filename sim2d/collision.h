#pragma once
// Box2D's narrow phase by several threads.

#include <box2d/box2d.h>

#include <cstdint>
#include <span>
#include <vector>

#include "common/world/team.h"

namespace talus::box2d {

/// Replaces b2ContactManager::Collide(), to the bit. There one thread walks a list of all contacts, from one place of
/// memory to the next, and later steps walk it again for those that touch. Here threads share the contacts that begin
/// or end nothing; the others follow in the order of the list, as in Box2D.
///
/// Only for worlds without sensors and joints, whose listener ignores contacts that persist.
class Collision {
 public:
  /// `bodies`: those that are awake.
  void collide(b2World& world, std::ptrdiff_t bodies, Team& team);

  /// The contacts that touch, in Box2D's order. Valid until a contact begins or ends.
  std::span<b2Contact* const> touching() const { return touching_; }

 private:
  enum class Found : std::uint8_t { apart, touching, changed };

  static Found follow(b2Contact& contact, const b2BroadPhase& broad_phase);

  std::vector<b2Contact*> contacts_;
  std::vector<Found> found_;
  std::vector<b2Contact*> touching_;
};

}  // namespace talus::box2d

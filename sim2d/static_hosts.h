#pragma once
// Frozen bodies as fixtures of a few shared static bodies. Box2D visits every body of the world in each step, static
// ones included, so frozen bodies must not be Box2D bodies of their own.

#include <box2d/box2d.h>

#include <span>
#include <utility>
#include <vector>

#include "sim2d/body_template.h"
#include "sim2d/tag.h"

namespace talus::box2d {

/// The shared static bodies (hosts) and the frozen bodies in each.
class StaticHosts {
 public:
  /// `capacity`: frozen bodies in one host.
  StaticHosts(b2World& world, int capacity) : world_(&world), capacity_(capacity) {}

  /// Adds solid, immovable fixtures at a pose. Returns the first; the body's others follow by GetNext().
  b2Fixture* add(BodyIndex body, const BodyTemplate& from, const b2Transform& pose, const b2Filter& filter);

  /// Removes the fixtures that add() returned.
  void remove(b2Fixture* first, const BodyTemplate& from);

  /// The contacts of the hosts to which these fixtures are attached, host by host, with the frozen body of each.
  std::vector<std::pair<b2Contact*, BodyIndex>> contacts_around(std::span<b2Fixture* const> fixtures) const;

  int hosts() const { return static_cast<int>(hosts_.size() - vacant_.size()); }

 private:
  struct Host {
    b2Body* body = nullptr;
    int frozen = 0;
  };
  std::size_t open_host();
  static std::size_t slot_of(b2Body& host) { return host.GetUserData().pointer; }

  b2World* world_;
  int capacity_;  // frozen bodies in one host
  std::vector<Host> hosts_;
  std::vector<std::size_t> vacant_;  // slots without a body
  std::vector<std::size_t> open_;    // slots with room; may name hosts that have been filled or dropped since
};

}  // namespace talus::box2d

#pragma once
// Frozen bodies as fixtures of a few shared static bodies. Box2D walks every body of the world in each step, static
// ones too; so sleepers must not be bodies of their own.

#include <box2d/box2d.h>

#include <algorithm>
#include <span>
#include <vector>

#include "sim2d/shapes.h"
#include "sim2d/tag.h"

namespace talus::box2d {

/// The hosts and who sleeps in which.
class Freezer {
 public:
  /// `shared`: whether sleepers share static bodies; each else has one of its own.
  Freezer(b2World& world, bool shared) : world_(&world), capacity_(shared ? 128 : 1) {}

  /// Solid, immovable fixtures at a pose. Returns the first of them; the body's others follow by GetNext().
  b2Fixture* freeze(BodyIndex body, std::span<const EngineShape> shapes, b2FixtureDef material,
                    const b2Transform& pose);

  /// Takes out the fixtures that freeze() returned.
  void thaw(b2Fixture* first, std::size_t pieces);

  /// Calls visit(contact, sleeper) for every touching contact of the hosts in which these fixtures are; each host once.
  template <typename Visit>
  void for_each_contact(std::span<b2Fixture* const> fixtures, Visit visit);

  int hosts() const { return static_cast<int>(hosts_.size() - vacant_.size()); }

 private:
  struct Host {
    b2Body* body = nullptr;
    int sleepers = 0;
  };
  std::size_t open_host();
  static std::size_t slot_of(b2Body& host) { return static_cast<std::size_t>(host.GetUserData().pointer); }

  b2World* world_;
  // Bodies in one host. Taking a fixture out walks its host's list, so a thaw gets dearer with more of them; a step
  // walks all hosts, so it gets dearer with fewer: at 128 a step of 100 awake bodies costs the same over 100,000
  // sleepers as over 1,000, at 64 it costs 7 % more, at 16 75 %; a single thaw costs up to 1.5 times one among 16.
  int capacity_;
  std::vector<Host> hosts_;
  std::vector<std::size_t> vacant_;  // slots without a body
  std::vector<std::size_t> open_;    // slots with room; may name hosts that have been filled or dropped since
};

template <typename Visit>
void Freezer::for_each_contact(std::span<b2Fixture* const> fixtures, Visit visit) {
  std::vector<std::size_t> slots;
  for (b2Fixture* fixture : fixtures) {
    slots.push_back(slot_of(*fixture->GetBody()));
  }
  std::ranges::sort(slots);
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  for (const std::size_t slot : slots) {
    for (b2ContactEdge* edge = hosts_[slot].body->GetContactList(); edge != nullptr; edge = edge->next) {
      b2Fixture& a = *edge->contact->GetFixtureA();
      b2Fixture& b = *edge->contact->GetFixtureB();
      visit(*edge->contact, owner_of(a.GetBody() == hosts_[slot].body ? a : b));
    }
  }
}

}  // namespace talus::box2d

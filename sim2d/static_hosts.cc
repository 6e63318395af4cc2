#include "sim2d/static_hosts.h"

#include <algorithm>

namespace talus::box2d {

std::size_t StaticHosts::open_host() {
  while (!open_.empty()) {
    const Host& host = hosts_[open_.back()];
    if (host.body != nullptr && host.frozen < capacity_) return open_.back();
    open_.pop_back();
  }
  if (vacant_.empty()) {
    vacant_.push_back(hosts_.size());
    hosts_.emplace_back();
  }
  const std::size_t slot = vacant_.back();
  vacant_.pop_back();
  b2BodyDef fixed;
  fixed.type = b2_staticBody;
  fixed.userData.pointer = slot;
  hosts_[slot] = {world_->CreateBody(&fixed), 0};
  open_.push_back(slot);
  return slot;
}

b2Fixture* StaticHosts::add(BodyIndex body, const BodyTemplate& from, const b2Transform& pose, const b2Filter& filter) {
  Host& host = hosts_[open_host()];
  ++host.frozen;
  b2FixtureDef fixture = from.material;
  fixture.filter = filter;
  std::vector<EnginePiece> pieces;
  for (const EnginePiece& piece : from.pieces) pieces.push_back(moved(piece, pose));
  return attach(*host.body, fixture, pieces, body);
}

void StaticHosts::remove(b2Fixture* first, const BodyTemplate& from) {
  const std::size_t slot = slot_of(*first->GetBody());
  Host& host = hosts_[slot];
  if (host.frozen == 1) {
    world_->DestroyBody(host.body);
    host = {};
    vacant_.push_back(slot);
    return;
  }
  for (std::size_t i = 0; i < from.pieces.size(); ++i) {
    b2Fixture* next = first->GetNext();
    host.body->DestroyFixture(first);
    first = next;
  }
  if (host.frozen == capacity_) open_.push_back(slot);
  --host.frozen;
}

std::vector<std::pair<b2Contact*, BodyIndex>> StaticHosts::contacts_around(std::span<b2Fixture* const> fixtures) const {
  std::vector<std::size_t> slots;
  for (b2Fixture* fixture : fixtures) slots.push_back(slot_of(*fixture->GetBody()));
  std::ranges::sort(slots);
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  std::vector<std::pair<b2Contact*, BodyIndex>> found;
  for (const std::size_t slot : slots)
    for (b2ContactEdge* edge = hosts_[slot].body->GetContactList(); edge != nullptr; edge = edge->next) {
      b2Fixture& a = *edge->contact->GetFixtureA();
      b2Fixture& b = *edge->contact->GetFixtureB();
      found.emplace_back(edge->contact, owner_of(a.GetBody() == hosts_[slot].body ? a : b));
    }
  return found;
}

}  // namespace talus::box2d

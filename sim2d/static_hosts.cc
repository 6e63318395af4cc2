#include "sim2d/static_hosts.h"

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
  b2Fixture* last = nullptr;
  int number = 0;
  for (const EnginePiece& own : from.pieces) {
    const EnginePiece piece = moved(own, pose);
    fixture.shape = &base(piece);
    fixture.userData = to_user_data(make_tag(body, number++));
    last = host.body->CreateFixture(&fixture);
  }
  return last;
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

}  // namespace talus::box2d

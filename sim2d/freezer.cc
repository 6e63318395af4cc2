#include "sim2d/freezer.h"

namespace talus::box2d {

std::size_t Freezer::open_host() {
  while (!open_.empty()) {
    const Host& host = hosts_[open_.back()];
    if (host.body != nullptr && host.sleepers < capacity_) {
      return open_.back();
    }
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

b2Fixture* Freezer::freeze(BodyIndex body, std::span<const EngineShape> shapes, b2FixtureDef material,
                           const b2Transform& pose) {
  Host& host = hosts_[open_host()];
  ++host.sleepers;
  b2Fixture* last = nullptr;
  for (std::size_t piece = 0; piece < shapes.size(); ++piece) {
    const EngineShape shape = moved(shapes[piece], pose);
    material.shape = &base(shape);
    material.userData = to_user_data(make_tag(body, static_cast<int>(piece)));
    last = host.body->CreateFixture(&material);
  }
  return last;
}

void Freezer::thaw(b2Fixture* first, std::size_t pieces) {
  const std::size_t slot = slot_of(*first->GetBody());
  Host& host = hosts_[slot];
  if (host.sleepers == 1) {
    world_->DestroyBody(host.body);
    host = {};
    vacant_.push_back(slot);
    return;
  }
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    b2Fixture* next = first->GetNext();
    host.body->DestroyFixture(first);
    first = next;
  }
  if (host.sleepers == capacity_) {
    open_.push_back(slot);
  }
  --host.sleepers;
}

}  // namespace talus::box2d

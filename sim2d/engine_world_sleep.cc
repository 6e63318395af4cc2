// The part of EngineWorld that puts bodies to sleep and wakes them.

#include <algorithm>

#include "sim2d/engine_world.h"

namespace talus::box2d {
namespace {

// Thawed bodies must stand where they stood, bit for bit: the engine's floats come back unchanged through our doubles,
// and the angle is kept as an angle, not as sine and cosine.
b2Transform stored_pose(const Pose<2>& pose) {
  return {to_engine(pose.position), b2Rot(static_cast<float>(pose.rotation.angle()))};
}

}  // namespace

void EngineWorld::note_engine_sleep() {
  if (!description_.engine_sleep) {
    return;
  }
  awake_.clear();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].body == nullptr) {
      continue;
    }
    const bool awake = bodies_[i].body->IsAwake();
    states_.asleep[i] = awake ? 0 : 1;
    if (awake) {
      awake_.push_back(static_cast<BodyIndex>(i));
    } else {
      states_.velocity[i].setZero();
      states_.spin[i].setZero();
    }
  }
}

std::vector<BodyIndex> EngineWorld::chosen(std::span<const BodyIndex> bodies, bool asleep) const {
  std::ranges::for_each(bodies, [this](BodyIndex body) { check_index(body); });
  std::vector<BodyIndex> result;
  std::ranges::copy_if(bodies, std::back_inserter(result),
                       [&](BodyIndex body) { return (states_.asleep[static_cast<std::size_t>(body)] != 0) == asleep; });
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

void EngineWorld::look_for_contacts() {
  if (proxies_moved_) {
    // Step() would do just this first. The engine shows its contact manager to readers only, but it is no constant.
    const_cast<b2ContactManager&>(world_.GetContactManager()).FindNewContacts();  // NOLINT(*-const-cast)
    proxies_moved_ = false;
  }
}

void EngineWorld::freeze(std::span<const BodyIndex> bodies) {
  std::vector<BodyIndex> falling_asleep = chosen(bodies, false);
  if (falling_asleep.empty()) {
    return;
  }
  gather_contacts();
  for (const BodyIndex body : falling_asleep) {
    for (const b2ContactEdge* edge = bodies_[static_cast<std::size_t>(body)].body->GetContactList(); edge != nullptr;
         edge = edge->next) {
      warm_start_.save(*edge->contact);
    }
  }
  // All go before the first comes back, last first: so every fixture gets its old number in the broad phase again,
  // which decides the side that Box2D measures a contact from.
  look_for_contacts();
  std::ranges::reverse(falling_asleep);
  for (const BodyIndex body : falling_asleep) {
    world_.DestroyBody(bodies_[static_cast<std::size_t>(body)].body);
  }
  std::ranges::reverse(falling_asleep);
  for (const BodyIndex body : falling_asleep) {
    const auto i = static_cast<std::size_t>(body);
    const Blueprint& blueprint = blueprint_of(body);
    bodies_[i] = {nullptr, freezer_.freeze(body, blueprint.shapes, blueprint.material, stored_pose(states_.pose[i]))};
    states_.asleep[i] = 1;
    states_.velocity[i].setZero();
    states_.spin[i].setZero();
  }
  proxies_moved_ = true;
  std::erase_if(awake_, [this](BodyIndex body) { return states_.asleep[static_cast<std::size_t>(body)] != 0; });
  note_engine_sleep();
}

void EngineWorld::thaw(std::span<const BodyIndex> bodies) {
  const std::vector<BodyIndex> waking = chosen(bodies, true);
  if (waking.empty()) {
    return;
  }
  gather_contacts();
  std::vector<b2Fixture*> fixtures;
  for (const BodyIndex body : waking) {
    const auto i = static_cast<std::size_t>(body);
    states_.asleep[i] = 0;
    warm_start_.wake(body);
    if (bodies_[i].frozen != nullptr) {
      fixtures.push_back(bodies_[i].frozen);
    } else {
      bodies_[i].body->SetAwake(true);  // asleep by the engine's own rule
    }
  }
  freezer_.for_each_contact(fixtures, [this](b2Contact& contact, BodyIndex sleeper) {
    if (states_.asleep[static_cast<std::size_t>(sleeper)] == 0) {
      warm_start_.save(contact);
    }
  });
  look_for_contacts();
  std::ranges::reverse(fixtures);  // see freeze()
  for (b2Fixture* fixture : fixtures) {
    freezer_.thaw(fixture, blueprint_of(owner_of(*fixture)).shapes.size());
  }
  for (const BodyIndex body : waking) {
    const auto i = static_cast<std::size_t>(body);
    if (bodies_[i].body == nullptr) {
      bodies_[i] = {create(body, Vec<2>::Zero(), Spin<2>::Zero()), nullptr};
    }
  }
  proxies_moved_ = true;
  const auto middle = static_cast<std::ptrdiff_t>(awake_.size());
  awake_.insert(awake_.end(), waking.begin(), waking.end());
  std::inplace_merge(awake_.begin(), awake_.begin() + middle, awake_.end());
  note_engine_sleep();
}

}  // namespace talus::box2d

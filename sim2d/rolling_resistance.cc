#include "sim2d/rolling_resistance.h"

#include <algorithm>
#include <utility>

#include "sim2d/tag.h"

namespace talus::box2d {
namespace {

std::uint64_t key_of(BodyIndex a, BodyIndex b) {
  return (std::uint64_t{static_cast<std::uint32_t>(std::min(a, b))} << 32) | static_cast<std::uint32_t>(std::max(a, b));
}

}  // namespace

RollingResistance::RollingResistance(const WorldDescription<2>& description, b2World& world)
    : world_(&world), dt_(description.dt) {
  for (const Shape<2>& shape : description.shapes) arms_.push_back(rolling_arm(shape));
  if (std::ranges::all_of(arms_, [](double arm) { return arm == 0.0; }))
    arms_.clear();
  else
    world.SetDestructionListener(this);
}

void RollingResistance::start_step(std::span<const int> shapes) {
  if (arms_.empty()) return;
  for (const std::uint64_t key : keys_) {
    pairs_.at(key).torque = 0.0F;
    pairs_.at(key).sleeps = false;
  }
  for (b2Contact* contact = world_->GetContactList(); contact != nullptr; contact = contact->GetNext())
    if (contact->IsTouching()) note(*contact, shapes);
  for (const std::uint64_t key : keys_) update(key, pairs_.at(key));
  std::erase_if(keys_, [this](std::uint64_t key) {
    const auto found = pairs_.find(key);
    const bool ended = found->second.joint == nullptr;
    if (ended) pairs_.erase(found);
    return ended;
  });
}

void RollingResistance::note(b2Contact& contact, std::span<const int> shapes) {
  b2Fixture& first = *contact.GetFixtureA();
  b2Fixture& second = *contact.GetFixtureB();
  const BodyIndex a = owner_of(first);
  const BodyIndex b = owner_of(second);
  const auto arm_of = [&](BodyIndex body) {
    return body >= 0 ? std::optional(arms_[shapes[body]]) : std::optional<double>();
  };
  const double arm = arm_of_pair(arm_of(a), arm_of(b));
  if (arm == 0.0) return;
  const std::uint64_t key = key_of(a, b);
  const auto [place, is_new] = pairs_.try_emplace(key);
  if (is_new) keys_.push_back(key);
  Pair& pair = place->second;
  pair.a = first.GetBody();
  pair.b = second.GetBody();
  const auto awake = [](const b2Body& body) { return body.GetType() == b2_dynamicBody && body.IsAwake(); };
  pair.sleeps = !awake(*pair.a) && !awake(*pair.b);
  float push = 0.0F;
  for (int i = 0; i < contact.GetManifold()->pointCount; ++i) push += contact.GetManifold()->points[i].normalImpulse;
  pair.torque += static_cast<float>(arm / dt_) * push;
}

/// Makes the joint of a pair that pushes, sets its limit, and removes that of a pair that no longer does.
void RollingResistance::update(std::uint64_t key, Pair& pair) {
  if (pair.sleeps) return;
  const bool other_bodies =
      pair.joint != nullptr && (pair.joint->GetBodyA() != pair.a || pair.joint->GetBodyB() != pair.b);
  if (pair.joint != nullptr && (pair.torque == 0.0F || other_bodies)) {
    world_->DestroyJoint(pair.joint);
    pair.joint = nullptr;
  }
  if (pair.torque == 0.0F) return;
  if (pair.joint == nullptr) {
    b2FrictionJointDef def;
    def.Initialize(pair.a, pair.b, pair.b->GetPosition());
    def.collideConnected = true;
    def.userData.pointer = key;
    pair.joint = static_cast<b2FrictionJoint*>(world_->CreateJoint(&def));
  }
  pair.joint->SetMaxTorque(pair.torque);
}

/// Box2D destroys the joints of a body that it destroys.
void RollingResistance::SayGoodbye(b2Joint* joint) {
  const auto found = pairs_.find(joint->GetUserData().pointer);
  if (found != pairs_.end() && found->second.joint == joint) found->second.joint = nullptr;
}

}  // namespace talus::box2d

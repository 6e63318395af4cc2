#include "sim2d/contacts.h"

#include <algorithm>
#include <tuple>

#include "sim2d/body_template.h"
#include "sim2d/conversions.h"

namespace talus::box2d {
namespace {

/// With the engine's own solver discs have none.
float skin_of(const b2Fixture& fixture) { return fixture.GetType() == b2Shape::e_circle ? 0.0F : skin; }

}  // namespace

/// In place of Box2D's rule, by which the larger restitution holds. It stays until the contact ends.
void ContactListener::BeginContact(b2Contact* contact) {
  contact->SetRestitution(static_cast<float>(
      pair_restitution(contact->GetFixtureA()->GetRestitution(), contact->GetFixtureB()->GetRestitution())));
}

void ContactListener::PreSolve(b2Contact* contact, const b2Manifold* before) {
  if (!warm_start_->empty() && before->pointCount == 0) warm_start_->apply(*contact);
  if (!recording_) return;
  b2WorldManifold world;
  contact->GetWorldManifold(&world);
  const b2Body& a = *contact->GetFixtureA()->GetBody();
  const b2Body& b = *contact->GetFixtureB()->GetBody();
  ContactRecord& record = records_[*contact];
  for (int i = 0; i < contact->GetManifold()->pointCount; ++i) {
    const b2Vec2 relative =
        a.GetLinearVelocityFromWorldPoint(world.points[i]) - b.GetLinearVelocityFromWorldPoint(world.points[i]);
    // Continuous collision updates a contact a second time within a step; the faster approach is the impact.
    record.approach[i] = std::max(record.approach[i], static_cast<double>(b2Dot(relative, world.normal)));
  }
}

void ContactListener::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
  continuous_->note_solved(*contact, sleepers_);
  if (!recording_) return;
  ContactRecord& record = records_[*contact];
  for (int i = 0; i < impulse->count; ++i) {
    record.normal[i] += impulse->normalImpulses[i];
    record.tangent[i] += impulse->tangentImpulses[i];
  }
}

void ContactListener::start_step(bool sleepers, bool recording) {
  sleepers_ = sleepers;
  recording_ = recording;
  records_.clear();
}

void ContactListener::gather(std::span<const std::uint8_t> asleep, std::vector<Contact<2>>& out) const {
  touches_.clear();
  for (const ContactRecord& record : records_.all()) {
    if (!record.contact->IsTouching()) continue;
    const bool swap = listed_under_second(owner_of(record.first), owner_of(record.second), asleep);
    touches_.push_back(swap ? Touch{record.second, record.first, &record}
                            : Touch{record.first, record.second, &record});
  }
  std::ranges::sort(touches_, {}, [](const Touch& touch) {
    return std::tuple(owner_of(touch.a), owner_of(touch.b), touch.b, touch.a);
  });
  for (const Touch& touch : touches_) append(touch, out);
}

void ContactListener::append(const Touch& touch, std::vector<Contact<2>>& out) {
  const ContactRecord& record = *touch.record;
  b2Contact& contact = *record.contact;
  const float skin_a = skin_of(*contact.GetFixtureA());
  const float skin_b = skin_of(*contact.GetFixtureB());
  const double sign =
      touch.a == record.first ? -1.0 : 1.0;  // Box2D's normal points from its first fixture to its second
  b2WorldManifold world;
  contact.GetWorldManifold(&world);
  const Vec2 normal = from_engine(world.normal);
  const Vec2 tangent = from_engine(b2Cross(world.normal, 1.0F));
  for (int i = 0; i < contact.GetManifold()->pointCount; ++i) {
    Contact<2>& c = out.emplace_back();
    c.a = owner_of(touch.a);
    c.b = owner_of(touch.b);
    c.point = from_engine(world.points[i]);
    c.normal = sign * normal;
    c.normal_impulse = record.normal[i];
    c.friction_impulse = sign * record.tangent[i] * tangent;
    c.approach_speed = record.approach[i];
    c.depth = -static_cast<double>(world.separations[i] + skin_a + skin_b);
  }
}

}  // namespace talus::box2d

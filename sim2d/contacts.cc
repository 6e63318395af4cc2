#include "sim2d/contacts.h"

#include <algorithm>
#include <tuple>

#include "sim2d/body_template.h"
#include "sim2d/conversions.h"

namespace talus::box2d {
namespace {

/// What Box2D adds around a shape: polygons and edges collide as if rounded, discs just as they are.
float skin(const b2Fixture& fixture) {
  return fixture.GetType() == b2Shape::e_circle ? 0.0F : fixture.GetShape()->m_radius;
}

/// Whether the contact is reported under the body on the other side of `edge`.
bool belongs_to_other(const b2ContactEdge& edge, BodyIndex index) {
  return edge.other->GetType() == b2_dynamicBody && edge.other->IsAwake() &&
         owner_of(*edge.other->GetFixtureList()) < index;
}

/// Order of a body's contacts: by the other's number, then by the pieces.
auto rank(b2Contact& contact, BodyIndex index) {
  const Tag a = tag_of(*contact.GetFixtureA());
  const Tag b = tag_of(*contact.GetFixtureB());
  return owner_of(a) == index ? std::tuple(owner_of(b), b, a) : std::tuple(owner_of(a), a, b);
}

}  // namespace

ContactListener::ContactListener(const WorldDescription<2>& description, const WarmStart& warm_start)
    : warm_start_(&warm_start), continuous_(description), mix_restitutions_(restitutions_differ(description)) {}

void ContactListener::BeginContact(b2Contact* contact) {
  if (mix_restitutions_) mix_restitution(*contact);
}

void ContactListener::PreSolve(b2Contact* contact, const b2Manifold* before) {
  if (!warm_start_->empty() && before->pointCount == 0) warm_start_->apply(*contact);
  if (!recording_) return;
  b2WorldManifold world;
  contact->GetWorldManifold(&world);
  const b2Body& a = *contact->GetFixtureA()->GetBody();
  const b2Body& b = *contact->GetFixtureB()->GetBody();
  ContactRecord& record = records_[contact];
  for (int i = 0; i < contact->GetManifold()->pointCount; ++i) {
    const b2Vec2 relative =
        a.GetLinearVelocityFromWorldPoint(world.points[i]) - b.GetLinearVelocityFromWorldPoint(world.points[i]);
    // Continuous collision updates a contact a second time within a step; the faster approach is the impact.
    record.approach[i] = std::max(record.approach[i], static_cast<double>(b2Dot(relative, world.normal)));
  }
}

void ContactListener::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
  if (sleepers_) continuous_.leave_out_if_slow(*contact);
  if (!recording_) return;
  ContactRecord& record = records_[contact];
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

void ContactListener::gather(b2Body& body, BodyIndex index, std::vector<Contact<2>>& out) {
  touching_.clear();
  for (const b2ContactEdge* edge = body.GetContactList(); edge != nullptr; edge = edge->next)
    if (edge->contact->IsTouching() && !belongs_to_other(*edge, index)) touching_.push_back(edge->contact);
  std::ranges::sort(touching_, {}, [index](b2Contact* contact) { return rank(*contact, index); });
  for (b2Contact* contact : touching_) append(*contact, index, out);
}

void ContactListener::append(b2Contact& contact, BodyIndex a, std::vector<Contact<2>>& out) const {
  b2Fixture& first = *contact.GetFixtureA();
  b2Fixture& second = *contact.GetFixtureB();
  const bool a_is_first = owner_of(first) == a;
  const double sign = a_is_first ? -1.0 : 1.0;  // Box2D's normal points from its first fixture to its second
  b2WorldManifold world;
  contact.GetWorldManifold(&world);
  const Vec2 normal = from_engine(world.normal);
  const Vec2 tangent = from_engine(b2Cross(world.normal, 1.0F));
  const ContactRecord* record = records_.find(&contact);
  for (int i = 0; i < contact.GetManifold()->pointCount; ++i) {
    const b2ManifoldPoint& point = contact.GetManifold()->points[i];
    const bool known = record != nullptr;
    Contact<2> c;
    c.a = a;
    c.b = owner_of(a_is_first ? second : first);
    c.point = from_engine(world.points[i]);
    c.normal = sign * normal;
    c.normal_impulse = known ? record->normal[i] : static_cast<double>(point.normalImpulse);
    c.friction_impulse = sign * (known ? record->tangent[i] : static_cast<double>(point.tangentImpulse)) * tangent;
    c.approach_speed = known ? record->approach[i] : 0.0;
    c.depth = -static_cast<double>(world.separations[i] + skin(first) + skin(second));
    out.push_back(c);
  }
}

}  // namespace talus::box2d

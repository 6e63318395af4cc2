#include "sim2d/collision.h"

namespace talus::box2d {
namespace {

/// What Box2D lets only derived classes see.
struct OpenContact : b2Contact {
  static bool is_to_be_filtered(const b2Contact& contact) {
    return (contact.*(&OpenContact::m_flags) & e_filterFlag) != 0;
  }
  static void set_filtered(b2Contact& contact) {
    (contact.*(&OpenContact::m_flags)) &= ~static_cast<std::uint32_t>(e_filterFlag);
  }
  static void update(b2Contact& contact, b2ContactListener* listener) { (contact.*(&OpenContact::Update))(listener); }
};
struct OpenFixture : b2Fixture {
  static std::int32_t proxy(const b2Fixture& fixture, std::int32_t child) {
    return (fixture.*(&OpenFixture::m_proxies))[child].proxyId;
  }
};

bool is_active(const b2Body& body) { return body.IsAwake() && body.GetType() != b2_staticBody; }

bool boxes_overlap(const b2Contact& contact, const b2BroadPhase& broad_phase) {
  const std::int32_t a = OpenFixture::proxy(*contact.GetFixtureA(), contact.GetChildIndexA());
  const std::int32_t b = OpenFixture::proxy(*contact.GetFixtureB(), contact.GetChildIndexB());
  return broad_phase.TestOverlap(a, b);
}

/// In two strides: a contact, then its bodies, whose addresses are in the contact.
void fetch_ahead(std::span<b2Contact* const> contacts, std::size_t i) {
  constexpr std::size_t stride = 4;
  if (i + 2 * stride >= contacts.size()) return;
  const auto* far = reinterpret_cast<const char*>(contacts[i + 2 * stride]);
  for (std::size_t at = 0; at < sizeof(b2Contact); at += 64) __builtin_prefetch(far + at);
  const b2Contact& near = *contacts[i + stride];
  __builtin_prefetch(&near.GetFixtureA()->GetBody()->GetTransform());
  __builtin_prefetch(&near.GetFixtureB()->GetBody()->GetTransform());
}

/// Impulses stay with the point of the same features.
void carry_impulses(const b2Manifold& before, b2Manifold& manifold) {
  for (std::int32_t i = 0; i < manifold.pointCount; ++i) {
    b2ManifoldPoint& point = manifold.points[i];
    point.normalImpulse = 0.0F;
    point.tangentImpulse = 0.0F;
    for (std::int32_t j = 0; j < before.pointCount; ++j) {
      if (before.points[j].id.key != point.id.key) continue;
      point.normalImpulse = before.points[j].normalImpulse;
      point.tangentImpulse = before.points[j].tangentImpulse;
      break;
    }
  }
}

/// As in b2ContactManager::Collide(). Returns whether the contact goes on.
bool update(b2Contact& contact, b2ContactManager& manager) {
  b2Body& a = *contact.GetFixtureA()->GetBody();
  b2Body& b = *contact.GetFixtureB()->GetBody();
  if (OpenContact::is_to_be_filtered(contact)) {
    b2ContactFilter* const filter = manager.m_contactFilter;
    const bool moves = a.GetType() == b2_dynamicBody || b.GetType() == b2_dynamicBody;
    if (!moves || (filter != nullptr && !filter->ShouldCollide(contact.GetFixtureA(), contact.GetFixtureB())))
      return false;
    OpenContact::set_filtered(contact);
  }
  if (!is_active(a) && !is_active(b)) return true;
  if (!boxes_overlap(contact, manager.m_broadPhase)) return false;
  OpenContact::update(contact, manager.m_contactListener);
  return true;
}

}  // namespace

void Collision::collide(b2World& world, std::ptrdiff_t bodies, Team& team) {
  // Box2D gives access to its contact manager for reading only.
  auto& manager = const_cast<b2ContactManager&>(world.GetContactManager());  // NOLINT(*-const-cast)
  contacts_.clear();
  found_.clear();
  const bool share = bodies >= bodies_to_share;
  for (b2Contact* contact = world.GetContactList(); contact != nullptr; contact = contact->GetNext()) {
    contacts_.push_back(contact);
    found_.push_back(share ? Found::changed : follow(*contact, manager.m_broadPhase));
  }
  const auto count = static_cast<int>(contacts_.size());
  if (share)
    team.divide(count, [&](int first, int last, int /*member*/) {
      for (int i = first; i < last; ++i) {
        fetch_ahead(contacts_, i);
        found_[i] = follow(*contacts_[i], manager.m_broadPhase);
      }
    });
  touching_.clear();
  for (int i = 0; i < count; ++i) {
    b2Contact* const contact = contacts_[i];
    if (found_[i] == Found::apart) continue;
    if (found_[i] == Found::changed && !update(*contact, manager))
      manager.Destroy(contact);
    else if (found_[i] == Found::touching || contact->IsTouching())
      touching_.push_back(contact);
  }
}

/// What b2Contact::Update() does with a contact that touches as it did, or is apart as it was.
auto Collision::follow(b2Contact& contact, const b2BroadPhase& broad_phase) -> Found {
  if (OpenContact::is_to_be_filtered(contact)) return Found::changed;
  const Found as_before = contact.IsTouching() ? Found::touching : Found::apart;
  const b2Body& a = *contact.GetFixtureA()->GetBody();
  const b2Body& b = *contact.GetFixtureB()->GetBody();
  if (!is_active(a) && !is_active(b)) return as_before;
  if (!boxes_overlap(contact, broad_phase)) return Found::changed;
  b2Manifold manifold = *contact.GetManifold();
  contact.Evaluate(&manifold, a.GetTransform(), b.GetTransform());
  if ((manifold.pointCount > 0) != contact.IsTouching()) return Found::changed;
  carry_impulses(*contact.GetManifold(), manifold);
  *contact.GetManifold() = manifold;
  return as_before;
}

}  // namespace talus::box2d

#include "sim3d/contacts.h"

#include <algorithm>
#include <tuple>

#include "sim3d/friction_impulse.h"
#include "sim3d/plane.h"

namespace talus::bullet {

template <int Dim>
void Contacts<Dim>::before_step(std::span<btRigidBody* const> awake) {
  if (!keep_motion_) {
    return;
  }
  moving_.clear();
  motion_.clear();
  for (const btRigidBody* body : awake) {
    moving_.push_back(body->getUserIndex());
    motion_.push_back({body->getLinearVelocity(), body->getAngularVelocity()});
  }
}

template <int Dim>
std::span<const Contact<Dim>> Contacts<Dim>::get(const Engine& engine) {
  keep_motion_ = true;
  if (!gathered_) {
    gather(engine);
    gathered_ = true;
  }
  return contacts_;
}

template <int Dim>
void Contacts<Dim>::gather(const Engine& engine) {
  contacts_.clear();
  for (int i = 0; i < engine.dispatcher.getNumManifolds(); ++i) {
    append(*const_cast<Engine&>(engine).dispatcher.getManifoldByIndexInternal(i));
  }
  // The manifolds' order depends on the history of pairs; points of one pair keep theirs.
  std::stable_sort(contacts_.begin(), contacts_.end(), [](const Contact<Dim>& l, const Contact<Dim>& r) {
    return std::tuple(l.a, l.b) < std::tuple(r.a, r.b);
  });
}

template <int Dim>
void Contacts<Dim>::append(const btPersistentManifold& manifold) {
  const btCollisionObject& first = *manifold.getBody0();
  const btCollisionObject& second = *manifold.getBody1();
  if (!first.isActive() && !second.isActive()) {
    return;
  }
  // The awake one is a, of two awake ones the first added.
  const bool swap = !first.isActive() || (second.isActive() && second.getUserIndex() < first.getUserIndex());
  const btCollisionObject& a = swap ? second : first;
  const btCollisionObject& b = swap ? first : second;
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    if (point.getDistance() > 0 && point.m_appliedImpulse <= 0) {
      continue;
    }
    const btVector3 normal = swap ? -point.m_normalWorldOnB : point.m_normalWorldOnB;  // Bullet's: from second to first
    const btVector3 friction = friction_impulse(point);
    const btVector3& where = point.getPositionWorldOnB();
    Contact<Dim>& contact = contacts_.emplace_back();
    contact.a = a.getUserIndex();
    contact.b = b.getUserIndex();
    contact.point = from_bullet<Dim>(where);
    contact.normal = from_bullet<Dim>(normal);
    contact.normal_impulse = point.m_appliedImpulse;
    contact.friction_impulse = from_bullet<Dim>(swap ? -friction : friction);
    contact.approach_speed = std::max(btScalar(0), normal.dot(velocity_before(b, where) - velocity_before(a, where)));
    contact.depth = -point.getDistance();
  }
}

template <int Dim>
btVector3 Contacts<Dim>::velocity_before(const btCollisionObject& object, const btVector3& point) const {
  const BodyIndex index = object.getUserIndex();
  const auto found = std::lower_bound(moving_.begin(), moving_.end(), index);
  if (found == moving_.end() || *found != index) {
    return {0, 0, 0};
  }
  const Motion& motion = motion_[static_cast<std::size_t>(found - moving_.begin())];
  return motion.velocity + motion.spin.cross(point - object.getWorldTransform().getOrigin());
}

template class Contacts<2>;
template class Contacts<3>;

}  // namespace talus::bullet

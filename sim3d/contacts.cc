#include "sim3d/contacts.h"

#include <algorithm>

#include "sim3d/bullet/fetch.h"
#include "sim3d/conversions.h"
#include "sim3d/friction_impulse.h"

namespace talus::bullet {

template <int Dim>
void Contacts<Dim>::note_motion(std::span<btRigidBody* const> bodies, std::span<btRigidBody* const> moving_obstacles) {
  first_ = bodies.empty() ? 0 : bodies.front()->getWorldArrayIndex();
  motion_.clear();
  for (const btRigidBody* body : bodies) motion_.emplace_back(*body);
  obstacles_.clear();
  for (const btRigidBody* obstacle : moving_obstacles) obstacles_.emplace_back(obstacle, Motion(*obstacle));
}

template <int Dim>
void Contacts<Dim>::gather(const Engine& engine, std::span<const std::uint8_t> asleep,
                           std::vector<Contact<Dim>>& contacts) const {
  find_touches(engine, asleep);
  std::ranges::sort(places_);
  for (const Place& place : places_) append(touches_[place.touch], contacts);
}

template <int Dim>
void Contacts<Dim>::find_touches(const Engine& engine, std::span<const std::uint8_t> asleep) const {
  touches_.clear();
  places_.clear();
  btPersistentManifold** manifolds = const_cast<Engine&>(engine).dispatcher.getInternalManifoldPointer();
  const int count = engine.dispatcher.getNumManifolds();
  for (int i = 0; i < count; ++i) {
    if (i + 12 < count) fetch_head(*manifolds[i + 12]);
    const btPersistentManifold& manifold = *manifolds[i];
    const btCollisionObject& first = *manifold.getBody0();
    const btCollisionObject& second = *manifold.getBody1();
    if (manifold.getNumContacts() == 0) continue;
    const bool swap = listed_under_second(first.getUserIndex(), second.getUserIndex(), asleep);
    const btCollisionObject& a = swap ? second : first;
    const btCollisionObject& b = swap ? first : second;
    if (a.getUserIndex() < 0 || asleep[a.getUserIndex()] != 0) continue;  // nor is b awake
    places_.push_back({pair_order(a.getUserIndex(), b.getUserIndex()), touches_.size()});
    touches_.push_back({&manifold, &a, &b, swap});
  }
}

template <int Dim>
void Contacts<Dim>::append(const Touch& touch, std::vector<Contact<Dim>>& contacts) const {
  const Motion motion_of_a = motion_before(*touch.a);
  const Motion motion_of_b = motion_before(*touch.b);
  for (int i = 0; i < touch.manifold->getNumContacts(); ++i) {
    const btManifoldPoint& point = touch.manifold->getContactPoint(i);
    const btScalar push = small_steps_ ? impulse_of_step(point) : point.m_appliedImpulse;
    if (point.getDistance() > 0 && push == 0) continue;
    const btVector3 normal = touch.swap ? -point.m_normalWorldOnB : point.m_normalWorldOnB;  // from second to first
    const btVector3 friction = small_steps_ ? friction_of_step(point) : friction_impulse(point);
    const btVector3& where = point.getPositionWorldOnB();
    const btVector3 approach = motion_of_b.at(*touch.b, where) - motion_of_a.at(*touch.a, where);
    Contact<Dim>& contact = contacts.emplace_back();
    contact.a = touch.a->getUserIndex();
    contact.b = touch.b->getUserIndex();
    contact.point = from_bullet<Dim>(where);
    contact.normal = from_bullet<Dim>(normal);
    contact.normal_impulse = impulse_unit_ * push;
    contact.friction_impulse = impulse_unit_ * from_bullet<Dim>(touch.swap ? -friction : friction);
    contact.approach_speed = std::max(btScalar(0), normal.dot(approach));
    contact.depth = -point.getDistance();
  }
}

template <int Dim>
typename Contacts<Dim>::Motion Contacts<Dim>::motion_before(const btCollisionObject& object) const {
  if (object.isKinematicObject()) {
    const auto moving = std::ranges::find(obstacles_, &object, &decltype(obstacles_)::value_type::first);
    return moving == obstacles_.end() ? Motion() : moving->second;
  }
  if (object.isStaticObject() || object.getUserIndex() < 0) return {};
  return motion_[object.getWorldArrayIndex() - first_];
}

template class Contacts<2>;
template class Contacts<3>;

}  // namespace talus::bullet

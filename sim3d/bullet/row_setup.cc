#include "sim3d/bullet/row_setup.h"

#include <LinearMath/btTransformUtil.h>

#include <algorithm>

#include "sim3d/friction_impulse.h"

namespace talus::bullet {
namespace {

void fetch(const btManifoldPoint& point) {
  const auto* memory = reinterpret_cast<const char*>(&point);
  for (std::size_t at = 0; at < sizeof(btManifoldPoint); at += 64) {
    __builtin_prefetch(memory + at);
  }
}

}  // namespace

void RowSetup::make(std::span<btCollisionObject*> bodies, std::span<btPersistentManifold*> manifolds,
                    const btContactSolverInfo& info, bool by_level, RowSystem& system) {
  const auto count = static_cast<std::int32_t>(bodies.size());
  bodies_.clear();
  system.clear(count + 1, count);
  for (btCollisionObject* each : bodies) {
    add_body(*each, info.m_timeStep, system);
  }
  bodies_.emplace_back();  // stands for all that never move
  find_contacts(manifolds, system);
  system.arrange(sides_, 2, by_level);
  last_frictions_.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (i + 4 < points_.size()) {
      fetch(*points_[i + 4]);
    }
    make_contact(i, info, system);
  }
  if (warm_friction_) {
    start_friction(system);
  }
}

// As initSolverBody and convertBodies.
void RowSetup::add_body(btCollisionObject& object, btScalar time_step, RowSystem& system) {
  btRigidBody& rigid = *btRigidBody::upcast(&object);
  const auto index = static_cast<std::int32_t>(bodies_.size());
  object.setCompanionId(index);
  Body& body = bodies_.emplace_back();
  body.rigid = &rigid;
  body.origin = rigid.getWorldTransform().getOrigin();
  body.force_impulse = rigid.getTotalForce() * rigid.getInvMass() * time_step;
  body.torque_impulse = rigid.getTotalTorque() * rigid.getInvInertiaTensorWorld() * time_step;
  if ((rigid.getFlags() & BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY) != 0) {
    body.torque_impulse += rigid.computeGyroscopicImpulseImplicit_Body(time_step);
  }
  body.velocity = rigid.getLinearVelocity() + body.force_impulse;
  body.spin = rigid.getAngularVelocity();
  body.pushed_spin = body.spin + body.torque_impulse;
  body.angular_factor = rigid.getAngularFactor();
  for (int i = 0; i < 3; ++i) {
    body.inv_inertia[i] = rigid.getInvInertiaTensorWorld().getRow(i);
  }
  body.inv_mass = rigid.getInvMass();
  const btScalar inv_mass = rigid.getInvMass();
  system.body(index).inv_mass = lanes(btVector3(inv_mass, inv_mass, inv_mass) * rigid.getLinearFactor());
}

void RowSetup::find_contacts(std::span<btPersistentManifold*> manifolds, RowSystem& system) {
  sides_.clear();
  points_.clear();
  const auto fixed = static_cast<std::int32_t>(bodies_.size() - 1);
  const auto index_of = [fixed](const btCollisionObject* object) {
    return btRigidBody::upcast(object) != nullptr ? object->getCompanionId() : fixed;
  };
  for (btPersistentManifold* manifold : manifolds) {
    const RowBodies sides = {index_of(manifold->getBody0()), index_of(manifold->getBody1())};
    if (to_vector(system.body(sides.a).inv_mass).fuzzyZero() && to_vector(system.body(sides.b).inv_mass).fuzzyZero()) {
      continue;  // Bullet takes bodies as heavy as that for immovable
    }
    for (int i = 0; i < manifold->getNumContacts(); ++i) {
      btManifoldPoint& point = manifold->getContactPoint(i);
      if (point.getDistance() <= manifold->getContactProcessingThreshold()) {
        sides_.push_back(sides);
        points_.push_back(&point);
      }
    }
  }
}

// After all normal impulses, in the order of the points.
void RowSetup::start_friction(RowSystem& system) const {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const float push = system.contact(i).applied;
    for (std::size_t direction = 0; direction < 2; ++direction) {
      PackedRow& row = system.friction(2 * i + direction);
      const float limit = row.friction() * push;
      row.applied = std::clamp(last_frictions_[i].dot(to_vector(row.normal)), -limit, limit);
      apply(row, system.body(row.a), system.body(row.b), splat(row.applied));
    }
  }
}

void RowSetup::write_back(const btContactSolverInfo& info, RowSystem& system) const {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (i + 4 < points_.size()) {
      fetch(*points_[i + 4]);
    }
    btManifoldPoint& point = *points_[i];
    point.m_appliedImpulse = system.contact(i).applied;
    point.m_appliedImpulseLateral1 = system.friction(2 * i).applied;
    point.m_appliedImpulseLateral2 = system.friction(2 * i + 1).applied;
    if (warm_friction_) {
      set_friction_impulse(point, friction_impulse(point));
    }
  }
  for (std::size_t i = 0; i + 1 < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const auto index = static_cast<std::int32_t>(i);
    const PackedBody& change = system.body(index);
    btRigidBody& rigid = *body.rigid;
    rigid.setLinearVelocity((rigid.getLinearVelocity() + to_vector(change.linear)) + body.force_impulse);
    rigid.setAngularVelocity((body.spin + to_vector(change.angular)) + body.torque_impulse);
    rigid.setCompanionId(-1);
    if (const PackedBody* push = system.push(index)) {
      const btVector3 linear = to_vector(push->linear);
      const btVector3 angular = to_vector(push->angular);
      if (!linear.isZero() || !angular.isZero()) {
        btTransform moved;
        btTransformUtil::integrateTransform(rigid.getWorldTransform(), linear, angular * info.m_splitImpulseTurnErp,
                                            info.m_timeStep, moved);
        rigid.setWorldTransform(moved);
      }
    }
  }
}

}  // namespace talus::bullet

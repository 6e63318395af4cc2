#include "sim3d/bullet/row_setup.h"

#include <LinearMath/btTransformUtil.h>

#include <algorithm>

#include "sim3d/friction_impulse.h"

namespace talus::bullet {
namespace {

void fetch(const btManifoldPoint& point) {
  const auto* memory = reinterpret_cast<const char*>(&point);
  for (std::size_t at = 0; at < sizeof(btManifoldPoint); at += 64) __builtin_prefetch(memory + at);
}

}  // namespace

void RowSetup::make(std::span<btCollisionObject*> bodies, std::span<btPersistentManifold*> manifolds,
                    const btContactSolverInfo& info, bool by_level, RowSystem& system) {
  const auto count = static_cast<std::int32_t>(bodies.size());
  bodies_.clear();
  system.clear(count + 1, count);
  for (btCollisionObject* each : bodies) add_body(*each, info.m_timeStep, system);
  fixed_ = count;
  bodies_.emplace_back();  // stands for all that never move
  find_contacts(manifolds, system);
  system.arrange(sides_, 2, by_level);
  last_frictions_.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (i + 4 < points_.size()) fetch(*points_[i + 4]);
    make_contact(i, info, system);
  }
  if (warm_friction_) start_friction(system);
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
  if ((rigid.getFlags() & BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY) != 0)
    body.torque_impulse += rigid.computeGyroscopicImpulseImplicit_Body(time_step);
  body.velocity = rigid.getLinearVelocity() + body.force_impulse;
  body.spin = rigid.getAngularVelocity();
  body.pushed_spin = body.spin + body.torque_impulse;
  body.angular_factor = rigid.getAngularFactor();
  for (int i = 0; i < 3; ++i) body.inv_inertia[i] = rigid.getInvInertiaTensorWorld().getRow(i);
  body.inv_mass = rigid.getInvMass();
  const btScalar inv_mass = rigid.getInvMass();
  system.body(index).inv_mass = lanes(btVector3(inv_mass, inv_mass, inv_mass) * rigid.getLinearFactor());
}

/// An obstacle that moves by plan: a velocity without a response.
void RowSetup::add_obstacle(btRigidBody& obstacle, RowSystem& system) {
  obstacle.setCompanionId(system.add_heavy_body());
  Body& body = bodies_.emplace_back();
  body.rigid = &obstacle;
  body.origin = obstacle.getWorldTransform().getOrigin();
  body.velocity = obstacle.getLinearVelocity();
  body.spin = body.pushed_spin = obstacle.getAngularVelocity();
}

std::int32_t RowSetup::index_of(btCollisionObject& object, RowSystem& system) {
  btRigidBody* rigid = btRigidBody::upcast(&object);
  if (rigid == nullptr) return fixed_;
  if (rigid->isKinematicObject() && rigid->getCompanionId() < 0) add_obstacle(*rigid, system);
  return rigid->getCompanionId();
}

void RowSetup::find_contacts(std::span<btPersistentManifold*> manifolds, RowSystem& system) {
  sides_.clear();
  points_.clear();
  const auto side = [&](const btCollisionObject* object) {
    return index_of(const_cast<btCollisionObject&>(*object), system);  // manifolds give const access only
  };
  for (btPersistentManifold* manifold : manifolds) {
    const RowBodies sides = {side(manifold->getBody0()), side(manifold->getBody1())};
    if (to_vector(system.body(sides.a).inv_mass).fuzzyZero() && to_vector(system.body(sides.b).inv_mass).fuzzyZero())
      continue;  // Bullet takes bodies as heavy as that for immovable
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
    if (i + 4 < points_.size()) fetch(*points_[i + 4]);
    btManifoldPoint& point = *points_[i];
    point.m_appliedImpulse = system.contact(i).applied;
    point.m_appliedImpulseLateral1 = system.friction(2 * i).applied;
    point.m_appliedImpulseLateral2 = system.friction(2 * i + 1).applied;
    if (warm_friction_) set_friction_impulse(point, friction_impulse(point));
  }
  for (std::size_t i = fixed_ + 1; i < bodies_.size(); ++i) bodies_[i].rigid->setCompanionId(-1);
  for (std::int32_t index = 0; index < fixed_; ++index) {
    const Body& body = bodies_[index];
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

namespace {

/// What the right-hand side of a point's normal row is made of.
struct NormalTarget {
  float rhs;   // target impulse [N s]
  float deep;  // impulse that moves deep bodies apart without giving them velocity [N s]; 0: not deep
};

/// As the end of setupContactConstraint. `approach`: of the normal row [m/s]; `gain`: [kg].
NormalTarget normal_target(const btManifoldPoint& point, const btContactSolverInfo& info, btScalar restitution,
                           btScalar approach, btScalar gain) {
  const btScalar inv_time_step = btScalar(1) / info.m_timeStep;
  const btScalar penetration = point.getDistance() + info.m_linearSlop;
  btScalar position_error = 0;
  btScalar velocity_error = restitution - approach;
  if (penetration > 0)
    velocity_error -= penetration * inv_time_step;
  else
    position_error = -penetration * info.m_erp2 * inv_time_step;
  const btScalar for_position = position_error * gain;
  const btScalar for_velocity = velocity_error * gain;
  if (penetration > info.m_splitImpulsePenetrationThreshold) return {for_position + for_velocity, 0};
  return {for_velocity, for_position};
}

/// Directions of friction, as convertContact chooses them: along the sliding and across, or any two.
void choose_friction(btManifoldPoint& point, const btVector3& velocity, btScalar approach) {
  const btVector3& normal = point.m_normalWorldOnB;
  btVector3& along = point.m_lateralFrictionDir1;
  btVector3& across = point.m_lateralFrictionDir2;
  along = velocity - normal * approach;
  const btScalar sliding = along.length2();
  if (sliding > SIMD_EPSILON) {
    along *= 1.F / btSqrt(sliding);
    across = along.cross(normal);
    across.normalize();
  } else {
    btPlaneSpace1(normal, along, across);
  }
}

/// The speed at which the surfaces are to part [m/s], as restitutionCurve.
btScalar bounce(const btManifoldPoint& point, btScalar approach, const btContactSolverInfo& info) {
  if (btFabs(approach) < info.m_restitutionVelocityThreshold) return 0;
  return std::max(btScalar(0), point.m_combinedRestitution * -approach);
}

/// Of a point of a body that may never move.
btVector3 velocity_at(const btRigidBody* body, const btVector3& reach) {
  return body != nullptr ? body->getVelocityInLocalPoint(reach) : btVector3(0, 0, 0);
}

}  // namespace

/// Three rows' parts on one of the two bodies.
struct RowSetup::Side {
  /// `axis`: the rows' directions on this body; `turn`: their torques.
  Side(const Body& body, const btVector3& reach, const Vectors& axis, const Vectors& torque, bool second)
      : turn(torque), effect(product(body.inv_inertia, torque, body.angular_factor)) {
    if (body.rigid == nullptr) turn = {splat(0), splat(0), splat(0)};
    const Vectors spin = three(body.pushed_spin, body.spin, body.spin);
    approach = dot(second ? -axis : axis, same(body.velocity)) + dot(turn, spin);
    response = splat(body.inv_mass) + dot(axis, cross(second ? -effect : effect, same(reach)));
  }
  Vectors turn;
  Vectors effect;
  Lanes approach = splat(0);  // velocity along the direction [m/s]
  Lanes response = splat(0);  // velocity per impulse [1/kg]
};

struct RowSetup::Sides {
  const Side& a;
  const Side& b;
};

void RowSetup::make_contact(std::size_t i, const btContactSolverInfo& info, RowSystem& system) {
  btManifoldPoint& point = *points_[i];
  const Body& a = body(sides_[i].a);
  const Body& b = body(sides_[i].b);
  const btVector3 reach_a = point.getPositionWorldOnA() - a.origin;
  const btVector3 reach_b = point.getPositionWorldOnB() - b.origin;
  const btVector3& normal = point.m_normalWorldOnB;
  if (warm_friction_) last_frictions_[i] = friction_impulse(point);
  const btVector3 velocity = (a.velocity + a.pushed_spin.cross(reach_a)) - (b.velocity + b.pushed_spin.cross(reach_b));
  choose_friction(point, velocity, normal.dot(velocity));

  const Vectors axis = three(normal, point.m_lateralFrictionDir1, point.m_lateralFrictionDir2);
  const Side on_a(a, reach_a, axis, cross(same(reach_a), axis), false);
  // Bullet turns round the torque of the normal and the direction of friction: the same but for the sign of a zero.
  const Vectors torque = cross(same(reach_b), axis);
  const Lanes zero = lanes(-0.F, 0, 0, 0);
  const Side on_b(b, reach_b, axis, {zero - torque.x, zero - torque.y, zero - torque.z}, true);
  const Lanes gain = splat(info.m_sor) / (on_a.response + on_b.response);
  const Lanes approach = on_a.approach + on_b.approach;

  btScalar restitution = 0;
  if (point.m_combinedRestitution != 0)
    restitution = bounce(point, normal.dot(velocity_at(a.rigid, reach_a) - velocity_at(b.rigid, reach_b)), info);
  const NormalTarget target = normal_target(point, info, restitution, first(approach), first(gain));
  float rhs[4];
  store(rhs, splat(0) + (splat(0) - approach) * gain);
  rhs[0] = target.rhs;
  write_rows(i, by_rows(axis, load(rhs)), {on_a, on_b}, gain, system);
  PackedRow& row = system.contact(i);
  row.applied = point.m_appliedImpulse * info.m_warmstartingFactor;
  apply(row, system.body(row.a), system.body(row.b), splat(row.applied));
  if (target.deep != 0) system.add_deep(i, target.deep);
}

void RowSetup::write_rows(std::size_t i, const ThreeRows& axes, const Sides& sides, Lanes gain,
                          RowSystem& system) const {
  const btManifoldPoint& point = *points_[i];
  const ThreeRows turns_a = by_rows(sides.a.turn, gain);
  const ThreeRows turns_b = by_rows(sides.b.turn, splat(point.m_combinedFriction));
  const ThreeRows effects_a = by_rows(sides.a.effect, splat(0));
  const ThreeRows effects_b = by_rows(sides.b.effect, splat(0));
  const auto [index_a, index_b] = sides_[i];
  const std::int32_t place = system.place_of_contact(i);
  PackedRow* const rows[3] = {&system.contact(i), &system.friction(2 * i), &system.friction(2 * i + 1)};
  for (int r = 0; r < 3; ++r) {
    *rows[r] = {axes.row[r], turns_a.row[r], turns_b.row[r], effects_a.row[r], effects_b.row[r], 0,
                index_a,     index_b,        place};
  }
}

}  // namespace talus::bullet

#include "sim3d/small_steps.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "sim3d/body_template.h"
#include "sim3d/friction_impulse.h"

namespace talus::bullet {
namespace {

// Between a vector of Bullet's and the solver's: the plane is Bullet's x and z, its turn against Bullet's about y
// (conversions.h).
template <int Dim>
VecF<Dim> to_solver(const btVector3& v) {
  if constexpr (Dim == 2)
    return {v.x(), v.z()};
  else
    return {v.x(), v.y(), v.z()};
}
template <int Dim>
SpinF<Dim> spin_to_solver(const btVector3& spin) {
  if constexpr (Dim == 2)
    return SpinF<2>(-spin.y());
  else
    return to_solver<3>(spin);
}
template <int Dim>
btVector3 from_solver(const VecF<Dim>& v) {
  return {v[0], Dim == 2 ? 0.0F : v[1], v[Dim - 1]};
}
template <int Dim>
btVector3 spin_from_solver(const SpinF<Dim>& spin) {
  if constexpr (Dim == 2)
    return {0.0F, -spin[0], 0.0F};
  else
    return from_solver<3>(spin);
}

template <int Dim>
InertiaF<Dim> inertia_to_solver(const btMatrix3x3& inverse) {
  if constexpr (Dim == 2) {
    return InertiaF<2>(inverse[1][1]);
  } else {
    InertiaF<3> made;
    for (int i = 0; i < 3; ++i) made.row(i) = to_solver<3>(inverse[i]).transpose();
    return made;
  }
}

template <int Dim>
SolverBody<Dim> awake_body(btRigidBody& rigid, float dt) {
  SolverBody<Dim> body;
  body.velocity = to_solver<Dim>(rigid.getLinearVelocity());
  body.spin = spin_to_solver<Dim>(rigid.getAngularVelocity());
  if constexpr (Dim == 3) body.free_spin_change = to_solver<3>(rigid.computeGyroscopicImpulseImplicit_Body(dt));
  body.inverse_mass = rigid.getInvMass();
  body.inverse_inertia = inertia_to_solver<Dim>(rigid.getInvInertiaTensorWorld());
  body.moves = true;
  return body;
}

/// A frozen body has its mass only in its template.
template <int Dim>
SolverBody<Dim> sleeper(const btCollisionObject& object) {
  const auto& shape = *static_cast<const BodyTemplate*>(object.getUserPointer());
  const btMatrix3x3& axes = object.getWorldTransform().getBasis();
  const btVector3 inverse(1 / shape.inertia.x(), 1 / shape.inertia.y(), 1 / shape.inertia.z());
  SolverBody<Dim> body;
  body.inverse_mass = 1 / shape.mass;
  body.inverse_inertia = inertia_to_solver<Dim>(axes.scaled(inverse) * axes.transpose());
  return body;
}

template <int Dim>
SolverBody<Dim> moving_obstacle(const btRigidBody& obstacle) {
  SolverBody<Dim> body;
  body.velocity = to_solver<Dim>(obstacle.getLinearVelocity());
  body.spin = spin_to_solver<Dim>(obstacle.getAngularVelocity());
  return body;
}

void fetch(const btManifoldPoint& point) {
  const auto* memory = reinterpret_cast<const char*>(&point);
  for (std::size_t at = 0; at < sizeof(btManifoldPoint); at += 64) __builtin_prefetch(memory + at);
}

/// The last bytes of a manifold, which hold its bodies and the number of its points.
void fetch_head(const btPersistentManifold& manifold) {
  const char* end = reinterpret_cast<const char*>(&manifold + 1);
  __builtin_prefetch(end - 64);
  __builtin_prefetch(end - 1);
}

// Two points of a planar pair that are nearer are one, at the front and the back of the bodies [extents of the
// smallest].
constexpr double one_point = 0.005;
// In the plane, a normal that points out of it by more (60 degrees) is of the bodies' flat faces, which must not
// matter.
constexpr float least_in_plane = 0.5F;

/// The arm of an object; none of what is no body.
std::optional<double> arm_of(const btCollisionObject& object) {
  if (object.getUserIndex() < 0) return std::nullopt;
  return static_cast<double>(object.getSpinningFriction());
}

}  // namespace

template <int Dim>
SmallSteps<Dim>::SmallSteps(const WorldDescription<Dim>& description, double fastest_spin)
    : params_{.sub_steps = description.solver.sub_steps,
              .restitution_threshold = static_cast<float>(description.solver.restitution_threshold)},
      dt_(static_cast<float>(description.dt)),
      fastest_spin_(static_cast<float>(fastest_spin)) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Shape<Dim>& shape : description.shapes) {
    smallest = std::min(smallest, shape.extent);
    rolling_friction_ = rolling_friction_ || shape.material.rolling_friction > 0.0;
  }
  one_point_ = static_cast<float>(one_point * smallest);
}

template <int Dim>
void SmallSteps<Dim>::solve(btDispatcher& dispatcher, std::span<btRigidBody* const> bodies, const btVector3& gravity) {
  ++step_;
  solver_.start();
  sources_.clear();
  parts_.clear();
  add_bodies(bodies);
  add_points(dispatcher);
  solver_.solve(params_, to_solver<Dim>(gravity), dt_);
  write_points();
  set_mean_velocities(bodies);
  for (btCollisionObject* other : others_) other->setCompanionId(-1);
  others_.clear();
}

/// Their slots are 1 and up.
template <int Dim>
void SmallSteps<Dim>::add_bodies(std::span<btRigidBody* const> bodies) {
  for (btRigidBody* body : bodies) body->setCompanionId(solver_.add(awake_body<Dim>(*body, dt_)));
}

template <int Dim>
int SmallSteps<Dim>::slot_of(const btCollisionObject& object) {
  if (object.getCompanionId() >= 0) return object.getCompanionId();
  const btRigidBody* rigid = btRigidBody::upcast(&object);
  if (rigid == nullptr && object.getUserIndex() < 0) return 0;
  auto& other = const_cast<btCollisionObject&>(object);  // manifolds give const access only
  other.setCompanionId(solver_.add(rigid != nullptr ? moving_obstacle<Dim>(*rigid) : sleeper<Dim>(object)));
  others_.push_back(&other);
  return other.getCompanionId();
}

template <int Dim>
void SmallSteps<Dim>::add_points(btDispatcher& dispatcher) {
  btPersistentManifold** manifolds = dispatcher.getInternalManifoldPointer();
  const int count = dispatcher.getNumManifolds();
  for (int i = 0; i < count; ++i) {
    if (i + 12 < count) fetch_head(*manifolds[i + 12]);
    if (i + 4 < count)
      for (int k = 0; k < manifolds[i + 4]->getNumContacts(); ++k) fetch(manifolds[i + 4]->getContactPoint(k));
    btPersistentManifold& manifold = *manifolds[i];
    if (manifold.getNumContacts() == 0) continue;
    // Bullet's normals point from the second body to the first.
    const int a = slot_of(*manifold.getBody1());
    const int b = slot_of(*manifold.getBody0());
    if (solver_.body(a).moves || solver_.body(b).moves) add_points(manifold, a, b);
  }
}

template <int Dim>
void SmallSteps<Dim>::add_points(btPersistentManifold& manifold, int a, int b) {
  const btVector3& centre_a = manifold.getBody1()->getWorldTransform().getOrigin();
  const btVector3& centre_b = manifold.getBody0()->getWorldTransform().getOrigin();
  const double arm = rolling_friction_ ? arm_of_pair(arm_of(*manifold.getBody0()), arm_of(*manifold.getBody1())) : 0.0;
  const auto first = static_cast<int>(parts_.size());
  SpinF<Dim> rolling = SpinF<Dim>::Zero();
  contacts_.clear();
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    ContactPoint<Dim> contact;
    contact.a = a;
    contact.b = b;
    contact.normal = to_solver<Dim>(point.m_normalWorldOnB);
    if constexpr (Dim == 2) {
      const float length = contact.normal.norm();
      if (length < least_in_plane) continue;
      contact.normal /= length;
    }
    contact.arm_a = to_solver<Dim>(point.getPositionWorldOnB() - centre_a);
    contact.arm_b = to_solver<Dim>(point.getPositionWorldOnA() - centre_b);
    contact.gap = point.getDistance();
    contact.friction = point.m_combinedFriction;
    contact.rolling_arm = static_cast<float>(arm);
    contact.restitution = point.m_combinedRestitution;
    contact.normal_impulse = point.m_appliedImpulse;
    contact.friction_impulse = to_solver<Dim>(friction_impulse(point));
    if (arm > 0.0) rolling += rolling_of_last_step(point);
    sources_.push_back({&point, add_point(contact, first)});
  }
  if (!contacts_.empty()) contacts_[0].rolling_impulse = rolling;
  for (const ContactPoint<Dim>& contact : contacts_) solver_.add(contact);
}

/// Joins the point with one of the same manifold, of which `first` is the first, where both are one in the plane.
template <int Dim>
int SmallSteps<Dim>::add_point(const ContactPoint<Dim>& contact, int first) {
  if constexpr (Dim == 2) {
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      ContactPoint<2>& known = contacts_[i];
      if ((known.arm_a - contact.arm_a).cwiseAbs().maxCoeff() > one_point_) continue;
      known.normal_impulse += contact.normal_impulse;
      known.friction_impulse += contact.friction_impulse;
      known.gap = std::min(known.gap, contact.gap);
      ++parts_[first + i];
      return first + static_cast<int>(i);
    }
  }
  contacts_.push_back(contact);
  parts_.push_back(1);
  return first + static_cast<int>(contacts_.size()) - 1;
}

/// Zero for a point that was not part of the last step.
template <int Dim>
SpinF<Dim> SmallSteps<Dim>::rolling_of_last_step(const btManifoldPoint& point) const {
  const auto mark = reinterpret_cast<std::uintptr_t>(point.m_userPersistentData);
  if (mark >> 32U != step_ - 1) return SpinF<Dim>::Zero();
  return rolling_[mark & 0xffffffffU];
}

template <int Dim>
void SmallSteps<Dim>::write_points() {
  const std::span<const ContactPoint<Dim>> points = solver_.points();
  for (const Source& source : sources_) {
    const ContactPoint<Dim>& contact = points[source.contact];
    btManifoldPoint& point = *source.point;
    const float share = 1.0F / static_cast<float>(parts_[source.contact]);
    point.m_appliedImpulse = share * contact.normal_impulse;
    set_friction_impulse(point, from_solver<Dim>(share * contact.friction_impulse));
    set_impulse_of_step(point, share * contact.normal_sum, from_solver<Dim>(share * contact.friction_sum));
  }
  if (!rolling_friction_) return;
  // Bullet keeps the mark when it finds the point again in the next step, and calls nothing when the point ends.
  static_assert(sizeof(std::uintptr_t) == 8);
  for (const Source& source : sources_) {
    const std::uintptr_t mark = (std::uintptr_t{step_} << 32U) | static_cast<std::uint32_t>(source.contact);
    source.point->m_userPersistentData = reinterpret_cast<void*>(mark);  // NOLINT(performance-no-int-to-ptr)
  }
  rolling_.clear();
  for (std::size_t i = 0; i < points.size(); ++i)
    rolling_.push_back(points[i].rolling_impulse / static_cast<float>(parts_[i]));
}

template <int Dim>
void SmallSteps<Dim>::set_mean_velocities(std::span<btRigidBody* const> bodies) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const SolverBody<Dim>& solved = solver_.body(static_cast<int>(i) + 1);
    bodies[i]->setLinearVelocity(from_solver<Dim>(solved.way / dt_));
    bodies[i]->setAngularVelocity(spin_from_solver<Dim>(solved.turn / dt_));
  }
}

template <int Dim>
void SmallSteps<Dim>::finish(std::span<btRigidBody* const> bodies) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const SolverBody<Dim>& solved = solver_.body(static_cast<int>(i) + 1);
    bodies[i]->setLinearVelocity(from_solver<Dim>(solved.velocity));
    const float share = fastest_spin_ / std::max(solved.spin.norm(), fastest_spin_);
    bodies[i]->setAngularVelocity(spin_from_solver<Dim>(share * solved.spin));
  }
}

template class SmallSteps<2>;
template class SmallSteps<3>;

}  // namespace talus::bullet

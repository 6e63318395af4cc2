#pragma once
// Between our vectors and Bullet's. A 2D world lies in Bullet's x-z plane at y = 0, its angle counter-clockwise with x
// to the right and z up: a right-handed turn about y goes the other way, hence the minus signs.

#include <LinearMath/btTransform.h>

#include <cmath>

#include "common/math/angle.h"
#include "common/math/vector.h"
#include "common/solver/solver_body.h"

namespace talus::bullet {

inline btVector3 to_bullet(const Vec<3>& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}
inline btVector3 to_bullet(const Vec<2>& v) {
  return {static_cast<btScalar>(v.x()), btScalar(0), static_cast<btScalar>(v.y())};
}

template <int Dim>
Vec<Dim> from_bullet(const btVector3& v) {
  if constexpr (Dim == 2)
    return {v.x(), v.z()};
  else
    return {v.x(), v.y(), v.z()};
}

template <int Dim>
btVector3 spin_to_bullet(const Spin<Dim>& spin) {
  if constexpr (Dim == 2)
    return {btScalar(0), static_cast<btScalar>(-spin[0]), btScalar(0)};
  else
    return to_bullet(spin);
}

template <int Dim>
Spin<Dim> spin_from_bullet(const btVector3& spin) {
  if constexpr (Dim == 2)
    return Spin<2>(-spin.y());
  else
    return from_bullet<3>(spin);
}

// The same for the vectors of the solver, in single precision as Bullet's.
template <int Dim>
VecF<Dim> to_solver(const btVector3& v) {
  if constexpr (Dim == 2)
    return {v.x(), v.z()};
  else
    return {v.x(), v.y(), v.z()};
}
template <int Dim>
btVector3 from_solver(const VecF<Dim>& v) {
  return {v[0], Dim == 2 ? 0.0F : v[1], v[Dim - 1]};
}
template <int Dim>
SpinF<Dim> spin_to_solver(const btVector3& spin) {
  if constexpr (Dim == 2)
    return SpinF<2>(-spin.y());
  else
    return to_solver<3>(spin);
}
template <int Dim>
btVector3 spin_from_solver(const SpinF<Dim>& spin) {
  if constexpr (Dim == 2)
    return {0.0F, -spin[0], 0.0F};
  else
    return from_solver<3>(spin);
}

inline Eigen::Quaterniond quaternion(const Rotation<3>& rotation) { return rotation.normalized(); }
inline Eigen::Quaterniond quaternion(const Rotation<2>& rotation) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(-rotation.angle(), Vec3::UnitY()));
}

inline btQuaternion to_bullet(const Eigen::Quaterniond& q) {
  return {static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()), static_cast<btScalar>(q.z()),
          static_cast<btScalar>(q.w())};
}

/// `frame`: turn from the axes Bullet keeps a body in to the body's own.
template <int Dim>
btTransform to_bullet(const Pose<Dim>& pose, const Eigen::Quaterniond& frame) {
  return btTransform(to_bullet(Eigen::Quaterniond(quaternion(pose.rotation) * frame)), to_bullet(pose.position));
}

/// The other way round; `frame_inverse` undoes `frame`.
template <int Dim>
Pose<Dim> from_bullet(const btTransform& transform, const Eigen::Quaterniond& frame_inverse) {
  btQuaternion turn;
  transform.getBasis().getRotation(turn);
  Eigen::Quaterniond q(turn.w(), turn.x(), turn.y(), turn.z());
  q = (q * frame_inverse).normalized();
  if constexpr (Dim == 2) {
    const double angle = wrapped(-2.0 * std::atan2(q.y(), q.w()));
    return {from_bullet<2>(transform.getOrigin()), Rotation<2>(angle)};
  } else {
    return {from_bullet<3>(transform.getOrigin()), q};
  }
}

}  // namespace talus::bullet

#include "common/policy/impulse.h"

namespace talus {
namespace {

/// Angular momentum of a momentum at a lever.
template <int Dim>
Spin<Dim> moment(const Vec<Dim>& lever, const Vec<Dim>& momentum) {
  if constexpr (Dim == 2) {
    return Spin<2>(lever[0] * momentum[1] - lever[1] * momentum[0]);
  } else {
    return lever.cross(momentum);
  }
}

/// Change of spin by an angular momentum.
template <int Dim>
Spin<Dim> turned_by(const Shape<Dim>& shape, const Pose<Dim>& pose, const Spin<Dim>& momentum) {
  if constexpr (Dim == 2) {
    return momentum / shape.inertia(0, 0);
  } else {
    const Vec3 own = pose.rotation.inverse() * momentum;
    return pose.rotation * shape.inertia.inverse() * own;
  }
}

}  // namespace

template <int Dim>
double yielding(const Shape<Dim>& shape, const Pose<Dim>& pose, const Vec<Dim>& place, const Vec<Dim>& along) {
  const Spin<Dim> turning = moment<Dim>(place - pose.position, along);
  return 1.0 / shape.mass + turning.dot(turned_by<Dim>(shape, pose, turning));
}

template <int Dim>
void push(const Shape<Dim>& shape, const Pose<Dim>& pose, const Vec<Dim>& place, const Vec<Dim>& impulse,
          Vec<Dim>& velocity, Spin<Dim>& spin) {
  velocity += impulse / shape.mass;
  spin += turned_by<Dim>(shape, pose, moment<Dim>(place - pose.position, impulse));
}

template double yielding(const Shape<2>&, const Pose<2>&, const Vec<2>&, const Vec<2>&);
template double yielding(const Shape<3>&, const Pose<3>&, const Vec<3>&, const Vec<3>&);
template void push(const Shape<2>&, const Pose<2>&, const Vec<2>&, const Vec<2>&, Vec<2>&, Spin<2>&);
template void push(const Shape<3>&, const Pose<3>&, const Vec<3>&, const Vec<3>&, Vec<3>&, Spin<3>&);

}  // namespace talus

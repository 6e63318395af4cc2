#include "common/shape/rigid_impulse.h"

namespace talus {
namespace {

/// Change of spin by an angular momentum.
template <int Dim>
Spin<Dim> spin_change(const Shape<Dim>& shape, const Pose<Dim>& pose, const Spin<Dim>& momentum) {
  if constexpr (Dim == 2) {
    return momentum / shape.inertia(0, 0);
  } else {
    const Vec3 local = pose.rotation.inverse() * momentum;
    return pose.rotation * shape.inertia.inverse() * local;
  }
}

}  // namespace

template <int Dim>
double inverse_effective_mass(const Shape<Dim>& shape, const Pose<Dim>& pose, const Vec<Dim>& point,
                              const Vec<Dim>& direction) {
  const Spin<Dim> unit_moment = moment(point - pose.position, direction);
  return 1.0 / shape.mass + unit_moment.dot(spin_change<Dim>(shape, pose, unit_moment));
}

template <int Dim>
void apply_impulse(const Shape<Dim>& shape, const Pose<Dim>& pose, const Vec<Dim>& point, const Vec<Dim>& impulse,
                   Vec<Dim>& velocity, Spin<Dim>& spin) {
  velocity += impulse / shape.mass;
  spin += spin_change<Dim>(shape, pose, moment(point - pose.position, impulse));
}

template double inverse_effective_mass(const Shape<2>&, const Pose<2>&, const Vec<2>&, const Vec<2>&);
template double inverse_effective_mass(const Shape<3>&, const Pose<3>&, const Vec<3>&, const Vec<3>&);
template void apply_impulse(const Shape<2>&, const Pose<2>&, const Vec<2>&, const Vec<2>&, Vec<2>&, Spin<2>&);
template void apply_impulse(const Shape<3>&, const Pose<3>&, const Vec<3>&, const Vec<3>&, Vec<3>&, Spin<3>&);

}  // namespace talus

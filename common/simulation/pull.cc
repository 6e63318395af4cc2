#include "common/simulation/pull.h"

#include <cmath>

#include "common/shape/rigid_impulse.h"

namespace talus {
namespace {

template <int Dim>
Vec<Dim> velocity_at(const Vec<Dim>& arm, const Vec<Dim>& velocity, const Spin<Dim>& spin) {
  if constexpr (Dim == 2)
    return velocity + spin[0] * Vec2(-arm[1], arm[0]);
  else
    return velocity + spin.cross(arm);
}

/// Column k: the velocity that a unit impulse along axis k at `point` gives this point.
template <int Dim>
Eigen::Matrix<double, Dim, Dim> inverse_mass_at(const Shape<Dim>& shape, const Pose<Dim>& pose, const Vec<Dim>& point) {
  Eigen::Matrix<double, Dim, Dim> columns;
  for (int axis = 0; axis < Dim; ++axis) {
    Vec<Dim> velocity = Vec<Dim>::Zero();
    Spin<Dim> spin = Spin<Dim>::Zero();
    apply_impulse<Dim>(shape, pose, point, Vec<Dim>::Unit(axis), velocity, spin);
    columns.col(axis) = velocity_at<Dim>(point - pose.position, velocity, spin);
  }
  return columns;
}

}  // namespace

template <int Dim>
VelocityChange<Dim> pulled(const World<Dim>& world, const Pull<Dim>& pull, double dt) {
  const BodyStates<Dim>& states = world.states();
  const Shape<Dim>& shape = world.shape_of(pull.body);
  const Pose<Dim>& pose = states.pose[pull.body];
  VelocityChange<Dim> change{pull.body, states.velocity[pull.body], states.spin[pull.body]};
  const Vec<Dim> point = pose * pull.point;
  const Vec<Dim> stretch = limited(Vec<Dim>(point - pull.target), shape.extent);

  const double gravity = world.gravity().norm();
  const double strength = pull_stiffness * (gravity > 0.0 ? gravity : 1.0);  // [m/s^2]
  const double rate = std::sqrt(strength / shape.extent);                    // [1/s]
  const double stiffness = shape.mass * rate * rate;                         // [N/m]
  const double damping = 2.0 * shape.mass * rate;                            // [N s/m], critical
  const double softness = 1.0 / (dt * (damping + dt * stiffness));           // [1/kg]
  const Vec<Dim> bias = dt * stiffness * softness * stretch;                 // [m/s]

  Eigen::Matrix<double, Dim, Dim> inverse_mass = inverse_mass_at<Dim>(shape, pose, point);
  inverse_mass.diagonal().array() += softness;
  const Vec<Dim> speed = velocity_at<Dim>(point - pose.position, change.velocity, change.spin);
  const Vec<Dim> impulse = -inverse_mass.inverse() * (speed + bias);
  // Twice the force of the spring stretched to the full leaves damping for a body that is struck.
  apply_impulse<Dim>(shape, pose, point, limited(impulse, 2.0 * shape.mass * strength * dt), change.velocity,
                     change.spin);
  change.velocity = limited(change.velocity, fastest_speed<Dim>(dt, world.units()));
  change.spin = limited(change.spin, fastest_spin(dt));
  return change;
}

template VelocityChange<2> pulled(const World<2>&, const Pull<2>&, double);
template VelocityChange<3> pulled(const World<3>&, const Pull<3>&, double);

}  // namespace talus

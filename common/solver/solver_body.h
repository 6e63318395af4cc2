#pragma once
// A body in the contact solver.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace talus {

/// Single precision, as the engines have it. Spins and turns are one number in 2D (counter-clockwise), a vector in 3D.
template <int Dim>
using VecF = Eigen::Matrix<float, Dim, 1>;
template <int Dim>
using SpinF = Eigen::Matrix<float, Dim == 2 ? 1 : 3, 1>;
template <int Dim>
using InertiaF = Eigen::Matrix<float, Dim == 2 ? 1 : 3, Dim == 2 ? 1 : 3>;

/// Velocity of the end of an arm by a spin, or its displacement by a small turn.
inline VecF<2> turned(const SpinF<2>& spin, const VecF<2>& arm) { return spin[0] * VecF<2>(-arm.y(), arm.x()); }
inline VecF<3> turned(const SpinF<3>& spin, const VecF<3>& arm) { return spin.cross(arm); }

/// A small displacement of a body or an obstacle.
template <int Dim>
struct StepMotion {
  VecF<Dim> way = VecF<Dim>::Zero();     // of its centre [m]
  SpinF<Dim> turn = SpinF<Dim>::Zero();  // [rad]

  VecF<Dim> of(const VecF<Dim>& arm) const { return way + turned(turn, arm); }
  StepMotion after(float share) const { return {share * way, share * turn}; }
  bool is_none() const { return way.isZero(0.0F) && turn.isZero(0.0F); }
};

/// A body in the solver.
///
/// Awake: its mass, and `moves`. Asleep: its mass too, but it does not move, so that contacts with it are as stiff as
/// when it was awake (else each sleep under load would shift what rests on it). An obstacle: no inverse mass; one that
/// moves has its velocity, which stays.
template <int Dim>
struct SolverBody {
  VecF<Dim> velocity = VecF<Dim>::Zero();                 // [m/s], before and after
  SpinF<Dim> spin = SpinF<Dim>::Zero();                   // [rad/s], before and after
  float inverse_mass = 0.0F;                              // [1/kg]
  InertiaF<Dim> inverse_inertia = InertiaF<Dim>::Zero();  // in world axes [1/(kg m^2)]
  bool moves = false;                                     // impulses and gravity act on it
  VecF<Dim> position = VecF<Dim>::Zero();                 // only for the division of many bodies among threads [m]
  VecF<Dim> way = VecF<Dim>::Zero();                      // after: motion in the step [m]
  SpinF<Dim> turn = SpinF<Dim>::Zero();                   // after: rotation in the step [rad]

  StepMotion<Dim> motion() const { return {way, turn}; }  // after: in the step
};

}  // namespace talus

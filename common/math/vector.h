#pragma once
// The vectors, rotations and boxes that 2D and 3D share. 2D vectors are (x, z), 3D vectors (x, y, z): the last axis is
// up everywhere. Lengths in metres, angles in radians, counter-clockwise seen with x to the right and z up.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace talus {

// Eigen aligns its types by the compiler's options, and a program must lay them out as the compiled library does.
static_assert(EIGEN_MAX_STATIC_ALIGN_BYTES <= 16,
              "talus: compile without AVX (-march=native, -mavx2), or with -DEIGEN_MAX_ALIGN_BYTES=16");

/// Position, velocity or extent, one entry per axis, the last one up.
template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
using Vec2 = Vec<2>;
using Vec3 = Vec<3>;

/// Angular velocity [rad/s]: one number in 2D, a vector in 3D.
template <int Dim>
using Spin = Eigen::Matrix<double, Dim == 2 ? 1 : 3, 1>;

namespace detail {
template <int Dim>
struct RotationOf;
template <>
struct RotationOf<2> {
  using type = Eigen::Rotation2D<double>;
};
template <>
struct RotationOf<3> {
  using type = Eigen::Quaternion<double>;
};
}  // namespace detail

/// Rotation from a body's own axes to the world's. Both kinds offer `r * vec`, `r * r`, inverse() and
/// toRotationMatrix().
template <int Dim>
using Rotation = typename detail::RotationOf<Dim>::type;

/// Axis-aligned box.
template <int Dim>
using Box = Eigen::AlignedBox<double, Dim>;

template <int Dim>
Rotation<Dim> identity_rotation() {
  if constexpr (Dim == 2)
    return Rotation<2>(0.0);
  else
    return Rotation<3>::Identity();
}

/// Where a body is: the position of its centre of mass [m] and its rotation.
template <int Dim>
struct Pose {
  Vec<Dim> position = Vec<Dim>::Zero();
  Rotation<Dim> rotation = identity_rotation<Dim>();

  /// A point given in the body's own axes, in the world's.
  Vec<Dim> operator*(const Vec<Dim>& local) const { return position + rotation * local; }
  bool operator==(const Pose& other) const {
    if constexpr (Dim == 2)
      return position == other.position && rotation.angle() == other.rotation.angle();
    else
      return position == other.position && rotation.coeffs() == other.rotation.coeffs();
  }
};

/// The part of a vector along a plane with this unit normal.
template <typename Vector>
Vector along_plane(const Vector& vector, const Vector& normal) {
  return vector - normal.dot(vector) * normal;
}

/// The constant spin that turns `from` into `to` within a time [s]: in 3D the shorter way round.
template <int Dim>
Spin<Dim> spin_between(const Rotation<Dim>& from, const Rotation<Dim>& to, double time) {
  if constexpr (Dim == 2) {
    return Spin<2>((to.angle() - from.angle()) / time);
  } else {
    const Eigen::AngleAxisd turn(to * from.conjugate());
    return turn.angle() / time * turn.axis();
  }
}

/// Height of a point: its last coordinate [m].
template <int Dim>
double height(const Vec<Dim>& point) {
  return point[Dim - 1];
}

/// The point without its height: x in 2D, (x, y) in 3D.
template <int Dim>
auto horizontal(const Vec<Dim>& point) {
  return point.template head<Dim - 1>();
}

}  // namespace talus

#pragma once
// Axes of a program, and those of talus, where the last one is up.

#include <cstdint>

#include "common/math/vector.h"

namespace talus {

/// The direction that is up in a program. In 2D z does not exist.
enum class UpAxis : std::uint8_t { x, y, z, minus_x, minus_y, minus_z };

/// The axis nearest to the opposite of `gravity`; without gravity the last one.
template <int Dim>
UpAxis up_against(const Vec<Dim>& gravity);

/// Turns the axes of a program into those of talus and back. A body's own axes stay as they are.
template <int Dim>
class AxisTurn {
 public:
  /// Throws InvalidValue on z in 2D.
  explicit AxisTurn(UpAxis up);

  Vec<Dim> in(const Vec<Dim>& vector) const { return matrix_ * vector; }
  Vec<Dim> out(const Vec<Dim>& vector) const { return matrix_.transpose() * vector; }
  Pose<Dim> in(const Pose<Dim>& pose) const { return {in(pose.position), rotation_ * pose.rotation}; }
  Pose<Dim> out(const Pose<Dim>& pose) const { return {out(pose.position), rotation_.inverse() * pose.rotation}; }
  Spin<Dim> spin_in(const Spin<Dim>& spin) const;
  Spin<Dim> spin_out(const Spin<Dim>& spin) const;

 private:
  Eigen::Matrix<double, Dim, Dim> matrix_;  // whole numbers, so vectors turn without rounding
  Rotation<Dim> rotation_;
};

}  // namespace talus

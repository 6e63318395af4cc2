#include "common/sleeper/up_axis.h"

#include "common/math/require.h"

namespace talus {
namespace {

struct SignedAxis {
  Eigen::Index axis = 0;
  double sign = 1.0;
};

SignedAxis signed_axis(UpAxis up) {
  const int number = static_cast<int>(up);
  return {number % 3, number < 3 ? 1.0 : -1.0};
}

}  // namespace

template <int Dim>
UpAxis up_against(const Vec<Dim>& gravity) {
  Eigen::Index axis = Dim - 1;
  if (gravity.cwiseAbs().maxCoeff(&axis) == 0.0) axis = Dim - 1;
  return static_cast<UpAxis>(axis + (gravity[axis] > 0.0 ? 3 : 0));
}

template <int Dim>
AxisTurn<Dim>::AxisTurn(UpAxis up) {
  const auto [axis, sign] = signed_axis(up);
  require(axis < Dim, "up", static_cast<double>(axis), "must be the number of an axis, 0 or 1 in 2D, up to 2 in 3D");
  // The axes follow each other cyclically, so that up comes last; a second axis turns over with it, which keeps the
  // turn a rotation.
  matrix_.setZero();
  for (Eigen::Index row = 0; row < Dim; ++row) matrix_(row, (axis + 1 + row) % Dim) = 1.0;
  if constexpr (Dim == 2)
    if (axis == 0) matrix_.row(0) *= -1.0;  // of two axes a cyclic change alone is a mirror
  if (sign < 0.0) {
    matrix_.row(Dim - 1) *= -1.0;
    matrix_.row(0) *= -1.0;
  }
  if constexpr (Dim == 2)
    rotation_.fromRotationMatrix(matrix_);
  else
    rotation_ = Eigen::Quaterniond(matrix_);
}

template <int Dim>
Spin<Dim> AxisTurn<Dim>::spin_in(const Spin<Dim>& spin) const {
  if constexpr (Dim == 2)
    return spin;
  else
    return matrix_ * spin;
}

template <int Dim>
Spin<Dim> AxisTurn<Dim>::spin_out(const Spin<Dim>& spin) const {
  if constexpr (Dim == 2)
    return spin;
  else
    return matrix_.transpose() * spin;
}

template UpAxis up_against<2>(const Vec<2>&);
template UpAxis up_against<3>(const Vec<3>&);
template class AxisTurn<2>;
template class AxisTurn<3>;

}  // namespace talus

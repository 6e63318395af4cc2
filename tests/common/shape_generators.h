#pragma once
// Random rotations, places and pieces for property tests.

#include <rapidcheck.h>

#include <numbers>

#include "common/shape/catalogue.h"

namespace talus::test {

/// A number of [low, high] in steps of a thousandth of it.
inline double random_number(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0;
}

template <int Dim>
Vec<Dim> random_point(double reach) {
  Vec<Dim> point;
  for (double& value : point) value = random_number(-reach, reach);
  return point;
}

template <int Dim>
Rotation<Dim> random_rotation() {
  const double angle = random_number(-std::numbers::pi, std::numbers::pi);
  if constexpr (Dim == 2) {
    return Rotation<2>(angle);
  } else {
    const Vec3 axis = random_point<3>(1.0) + Vec3(0.0, 0.0, 3.0);
    return Rotation<3>(Eigen::AngleAxisd(angle, axis.normalized()));
  }
}

template <int Dim>
Pose<Dim> random_pose() {
  const Vec<Dim> position = random_point<Dim>(5.0);
  return {position, random_rotation<Dim>()};
}

/// A simplex, stretched and pushed about, but never flat.
template <int Dim>
HullPiece<Dim> random_simplex() {
  HullPiece<Dim> hull = {{Vec<Dim>::Zero()}};
  for (int axis = 0; axis < Dim; ++axis) hull.corners.push_back(Vec<Dim>::Unit(axis) + random_point<Dim>(0.3));
  return hull;
}

/// The corners of a box at any pose, in space only.
inline HullPiece<3> random_box_hull() {
  const Pose<3> pose = random_pose<3>();
  const Vec3 half = Vec3::Constant(1.2) + random_point<3>(1.0);
  HullPiece<3> hull;
  for (int i = 0; i < 8; ++i) {
    const Vec3 sides((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0);
    hull.corners.push_back(pose * Vec3(half.cwiseProduct(sides)));
  }
  return hull;
}

/// A piece of any kind near the origin.
template <int Dim>
Piece<Dim> random_piece() {
  const int kind = *rc::gen::inRange(0, 4);
  const Pose<Dim> pose = random_pose<Dim>();
  const double radius = random_number(0.1, 1.0);
  if (kind == 0) return BoxPiece<Dim>{pose, Vec<Dim>::Constant(1.2) + random_point<Dim>(1.0)};
  if (kind == 1) return HullPiece<Dim>{{pose.position}, radius};
  if (kind == 2) return HullPiece<Dim>{{pose.position, pose * Vec<Dim>::Unit(0)}, radius};
  return random_simplex<Dim>();
}

/// The piece turned and moved.
template <int Dim>
Piece<Dim> placed(Piece<Dim> piece, const Pose<Dim>& pose) {
  if (auto* box = std::get_if<BoxPiece<Dim>>(&piece))
    box->pose = {pose * box->pose.position, pose.rotation * box->pose.rotation};
  else
    for (Vec<Dim>& corner : std::get<HullPiece<Dim>>(piece).corners) corner = pose * corner;
  return piece;
}

}  // namespace talus::test

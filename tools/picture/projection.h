#pragma once
// Where points of the world come to lie on the page.

#include <span>

#include "common/math/vector.h"

namespace talus {

/// 2D: a scale drawing. Page coordinates are pixels, y down.
template <int Dim>
struct Projection {
  static_assert(Dim == 2);
  double scale = 1.0;         // [px/m]
  Vec2 shift = Vec2::Zero();  // page position of the origin [px]

  Vec2 on_page(const Vec2& point) const { return shift + scale * Vec2(point.x(), -point.y()); }
  double pixels_per_metre() const { return scale; }
};

/// 3D: a camera, or with `distance` 0 a parallel projection. The third coordinate is the nearness of a point: larger is
/// nearer, and on a plane of the world it is linear over the page.
template <>
struct Projection<3> {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // rows: right, up and backwards
  Vec3 target = Vec3::Zero();                          // the middle of interest
  double distance = 0.0;                               // [m] from the eye to the target
  double scale = 1.0;         // [px] of a length at the target, times distance; [px/m] in parallel projection
  Vec2 shift = Vec2::Zero();  // page position of the target [px]

  /// Seen from the target, the eye lies in direction `towards_eye`.
  static Projection looking_along(const Vec3& towards_eye, const Vec3& target, double distance);

  Vec3 project(const Vec3& point) const;
  /// The point of the world at a page position and nearness.
  Vec3 unproject(const Vec3& projected) const;
  Vec2 on_page(const Vec3& point) const { return project(point).head<2>(); }
  double pixels_per_metre() const { return distance > 0.0 ? scale / distance : scale; }
  /// Unit vector from a point towards the eye.
  Vec3 towards_eye(const Vec3& point) const;
  /// How far a point lies before the eye along the line of sight [m]; a camera sees points from near_limit() on.
  double depth(const Vec3& point) const { return distance - axes.row(2).dot(point - target); }
  double near_limit() const { return 0.05 * distance; }
};

/// Sets scale and shift so that the points fill `area` [px] as far as they can, in its middle; returns the size that
/// they take there. A span of points without extent gets a scale all the same.
template <int Dim>
Vec2 fit(Projection<Dim>& projection, std::span<const Vec<Dim>> points, const Box<2>& area) {
  projection.scale = 1.0;
  projection.shift = Vec2::Zero();
  Box<2> bounds;
  for (const Vec<Dim>& point : points) bounds.extend(projection.on_page(point));
  const Vec2 size = bounds.sizes().cwiseMax(1e-9);
  projection.scale = area.sizes().cwiseQuotient(size).minCoeff();
  projection.shift = area.center() - projection.scale * bounds.center();
  return projection.scale * size;
}

}  // namespace talus

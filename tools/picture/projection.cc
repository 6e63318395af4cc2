#include "tools/picture/projection.h"

#include <cmath>

namespace talus {

Projection<3> Projection<3>::looking_along(const Vec3& towards_eye, const Vec3& target, double distance) {
  Projection<3> projection;
  const Vec3 back = towards_eye.normalized();
  const Vec3 side = std::abs(back.z()) < 0.999 ? Vec3::UnitZ() : Vec3::UnitY();
  const Vec3 right = side.cross(back).normalized();
  projection.axes.row(0) = right.transpose();
  projection.axes.row(1) = back.cross(right).transpose();
  projection.axes.row(2) = back.transpose();
  projection.target = target;
  projection.distance = distance;
  return projection;
}

Vec3 Projection<3>::project(const Vec3& point) const {
  const Vec3 seen = axes * (point - target);
  const double nearness = distance > 0.0 ? 1.0 / (distance - seen.z()) : seen.z();
  const double factor = distance > 0.0 ? scale * nearness : scale;
  return {shift.x() + factor * seen.x(), shift.y() - factor * seen.y(), nearness};
}

Vec3 Projection<3>::unproject(const Vec3& projected) const {
  const double factor = distance > 0.0 ? scale * projected.z() : scale;
  const double height = distance > 0.0 ? distance - 1.0 / projected.z() : projected.z();
  const Vec3 seen((projected.x() - shift.x()) / factor, (shift.y() - projected.y()) / factor, height);
  return target + axes.transpose() * seen;
}

Vec3 Projection<3>::towards_eye(const Vec3& point) const {
  const Vec3 back = axes.row(2).transpose();
  return distance > 0.0 ? Vec3((target + distance * back - point).normalized()) : back;
}

}  // namespace talus

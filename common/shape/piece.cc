#include "common/shape/piece.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/math/require_finite.h"
#include "common/shape/convex_hull.h"
#include "common/shape/polygon.h"

namespace talus {
namespace {

// Least over the edges of the largest distance of a corner from it.
double width(const std::vector<Vec2>& corners) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& to = corners[(i + 1) % corners.size()];
    double largest = 0.0;
    for (const Vec2& corner : corners) largest = std::max(largest, distance_from_line(corner, corners[i], to));
    least = std::min(least, largest);
  }
  return least;
}

double width(const std::vector<Vec3>& corners) {
  const std::vector<std::vector<int>> faces = convex_hull_faces(corners);
  double least = faces.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (const std::vector<int>& face : faces) {
    const Vec3& origin = corners[face[0]];
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
      normal += (corners[face[i]] - origin).cross(corners[face[i + 1]] - origin);
    normal.normalize();
    double largest = 0.0;
    for (const Vec3& corner : corners) largest = std::max(largest, -normal.dot(corner - origin));
    least = std::min(least, largest);
  }
  return least;
}

template <int Dim>
std::vector<Vec<Dim>> corners_of(const BoxPiece<Dim>& box) {
  std::vector<Vec<Dim>> corners;
  const std::array<std::array<int, 2>, 4> round = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (const auto& [x, last] : round) {
    if constexpr (Dim == 2)
      corners.push_back(box.pose * Vec2(x * box.half.x(), last * box.half.y()));
    else
      for (const int y : {-1, 1})
        corners.push_back(box.pose * Vec3(x * box.half.x(), y * box.half.y(), last * box.half.z()));
  }
  return corners;
}

void require_length(double length, const std::string& field) {
  require(std::isfinite(length) && length > 0.0, field, length, "must be finite and above 0 m");
}

void check_corners(const std::vector<Vec2>& corners, const std::string& field) {
  const std::size_t count = corners.size();
  check_corner_count<2>(count, field);
  const std::size_t bad = non_convex_corner(corners).value_or(count);
  require(bad == count, fmt::format("{}[{}]", field, bad), text(corners[bad % count]),
          "must be a corner of a convex polygon, no three corners on one line");
}

void check_corners(const std::vector<Vec3>& corners, const std::string& field) {
  check_corner_count<3>(corners.size(), field);
  Box<3> bounds;
  for (const Vec3& corner : corners) bounds.extend(corner);
  const double thickness = width(corners);
  require(thickness > flatness * bounds.diagonal().norm(), field + " thickness", thickness,
          "must be at least four points that do not lie in one plane");
}

template <int Dim>
void check_kind(const BoxPiece<Dim>& box, const std::string& field) {
  require_finite(box.pose.position, field + ".position");
  check_rotation<Dim>(box.pose.rotation, field + ".rotation");
  for (int axis = 0; axis < Dim; ++axis) require_length(box.half[axis], fmt::format("{}.half[{}]", field, axis));
}

template <int Dim>
void check_kind(const HullPiece<Dim>& hull, const std::string& field) {
  for (std::size_t i = 0; i < hull.corners.size(); ++i)
    require_finite(hull.corners[i], fmt::format("{}.corners[{}]", field, i));
  if (!hull.round()) {
    require(hull.radius == 0.0, field + ".radius", hull.radius, "must be 0: only one or two corners have a radius");
    check_corners(hull.corners, field + ".corners");
    return;
  }
  require(!hull.corners.empty(), field + ".corners.size", 0.0, "must be one or more");
  require_length(hull.radius, field + ".radius");
  if (hull.corners.size() == 2)
    require_length((hull.corners[1] - hull.corners[0]).norm(), field + " distance of corners");
}

}  // namespace

template <int Dim>
HullPiece<Dim> as_hull(const Piece<Dim>& piece) {
  const auto* box = std::get_if<BoxPiece<Dim>>(&piece);
  return box != nullptr ? HullPiece<Dim>{corners_of(*box)} : std::get<HullPiece<Dim>>(piece);
}

template <int Dim>
void translate(Piece<Dim>& piece, const Vec<Dim>& by) {
  if (auto* box = std::get_if<BoxPiece<Dim>>(&piece))
    box->pose.position += by;
  else
    for (Vec<Dim>& corner : std::get<HullPiece<Dim>>(piece).corners) corner += by;
}

template <int Dim>
Piece<Dim> placed(const Piece<Dim>& piece, const Pose<Dim>& pose) {
  Piece<Dim> result = piece;
  if (auto* box = std::get_if<BoxPiece<Dim>>(&result))
    box->pose = {pose * box->pose.position, pose.rotation * box->pose.rotation};
  else
    for (Vec<Dim>& corner : std::get<HullPiece<Dim>>(result).corners) corner = pose * corner;
  return result;
}

template <int Dim>
void scale(Piece<Dim>& piece, double factor) {
  if (auto* box = std::get_if<BoxPiece<Dim>>(&piece)) {
    box->pose.position *= factor;
    box->half *= factor;
    return;
  }
  auto& hull = std::get<HullPiece<Dim>>(piece);
  hull.radius *= factor;
  for (Vec<Dim>& corner : hull.corners) corner *= factor;
}

template <int Dim>
Box<Dim> bounds_of(const Piece<Dim>& piece, const Eigen::Matrix<double, Dim, Dim>& turn, const Vec<Dim>& position) {
  Box<Dim> bounds;
  if (const auto* box = std::get_if<BoxPiece<Dim>>(&piece)) {
    const Eigen::Matrix<double, Dim, Dim> axes = turn * box->pose.rotation.toRotationMatrix();
    const Vec<Dim> reach = axes.cwiseAbs() * box->half;
    const Vec<Dim> centre = position + turn * box->pose.position;
    bounds.extend(Box<Dim>(centre - reach, centre + reach));
  } else {
    const auto& hull = std::get<HullPiece<Dim>>(piece);
    const Vec<Dim> reach = Vec<Dim>::Constant(hull.radius);
    for (const Vec<Dim>& corner : hull.corners) {
      const Vec<Dim> centre = position + turn * corner;
      bounds.extend(Box<Dim>(centre - reach, centre + reach));
    }
  }
  return bounds;
}

template <int Dim>
double reach_of(const Piece<Dim>& piece) {
  const HullPiece<Dim> hull = as_hull(piece);
  double distance = 0.0;
  for (const Vec<Dim>& corner : hull.corners) distance = std::max(distance, corner.norm());
  return distance + hull.radius;
}

template <int Dim>
double smallest_width(const Piece<Dim>& piece) {
  if (const auto* box = std::get_if<BoxPiece<Dim>>(&piece)) return 2.0 * box->half.minCoeff();
  const auto& hull = std::get<HullPiece<Dim>>(piece);
  return hull.round() ? 2.0 * hull.radius : width(hull.corners);
}

template <int Dim>
void check_piece(const Piece<Dim>& piece, const std::string& field) {
  std::visit([&](const auto& kind) { check_kind(kind, field); }, piece);
}

template <int Dim>
void check_corner_count(std::size_t count, const std::string& field) {
  const bool right = Dim == 2 ? count >= 3 && count <= most_corners : count >= 4;
  require(right, field + ".size", static_cast<double>(count), Dim == 2 ? "must be 3 to 8" : "must be 4 or more");
}

template <int Dim>
void check_rotation(const Rotation<Dim>& rotation, const std::string& field) {
  if constexpr (Dim == 2)
    require(std::isfinite(rotation.angle()), field, rotation.angle(), "must be finite");
  else
    require(std::abs(rotation.norm() - 1.0) < 1e-6, field + " length", rotation.norm(), "must be finite and 1");
}

template HullPiece<2> as_hull(const Piece<2>&);
template HullPiece<3> as_hull(const Piece<3>&);
template void translate(Piece<2>&, const Vec<2>&);
template void translate(Piece<3>&, const Vec<3>&);
template Piece<2> placed(const Piece<2>&, const Pose<2>&);
template Piece<3> placed(const Piece<3>&, const Pose<3>&);
template void scale<2>(Piece<2>&, double);
template void scale<3>(Piece<3>&, double);
template Box<2> bounds_of(const Piece<2>&, const Eigen::Matrix2d&, const Vec<2>&);
template Box<3> bounds_of(const Piece<3>&, const Eigen::Matrix3d&, const Vec<3>&);
template double reach_of(const Piece<2>&);
template double reach_of(const Piece<3>&);
template double smallest_width(const Piece<2>&);
template double smallest_width(const Piece<3>&);
template void check_piece(const Piece<2>&, const std::string&);
template void check_piece(const Piece<3>&, const std::string&);
template void check_corner_count<2>(std::size_t, const std::string&);
template void check_corner_count<3>(std::size_t, const std::string&);
template void check_rotation<2>(const Rotation<2>&, const std::string&);
template void check_rotation<3>(const Rotation<3>&, const std::string&);

}  // namespace talus

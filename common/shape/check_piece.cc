#include "common/shape/check_piece.h"

#include <fmt/format.h>

#include "common/math/require.h"
#include "common/shape/piece_width.h"
#include "common/shape/polygon.h"

namespace talus {
namespace {

template <int Dim>
void require_finite(const Vec<Dim>& point, const std::string& field) {
  for (int axis = 0; axis < Dim; ++axis) {
    require(std::isfinite(point[axis]), fmt::format("{}[{}]", field, axis), point[axis], "must be finite");
  }
}

void require_length(double length, const std::string& field) {
  require(std::isfinite(length) && length > 0.0, field, length, "must be finite and above 0 m");
}

double diagonal(const std::vector<Vec3>& corners) {
  Box<3> bounds;
  for (const Vec3& corner : corners) {
    bounds.extend(corner);
  }
  return bounds.diagonal().norm();
}

void check_corners(const std::vector<Vec2>& corners, const std::string& field) {
  const std::size_t count = corners.size();
  require(count >= 3 && count <= most_corners, field + ".size", static_cast<double>(count), "must be 3 to 8");
  const std::size_t bad = non_convex_corner(corners).value_or(count);
  require(bad == count, fmt::format("{}[{}]", field, bad), text(corners[bad % count]),
          "must be a corner of a convex polygon given counter-clockwise, no three corners on one line");
}

void check_corners(const std::vector<Vec3>& corners, const std::string& field) {
  require(corners.size() >= 4, field + ".size", static_cast<double>(corners.size()), "must be 4 or more");
  const double thickness = smallest_width<3>(HullPiece<3>{corners});
  require(thickness > flatness * diagonal(corners), field + " thickness", thickness,
          "must be at least four points that do not lie in one plane");
}

template <int Dim>
void check_kind(const BoxPiece<Dim>& box, const std::string& field) {
  require_finite<Dim>(box.pose.position, field + ".position");
  check_rotation<Dim>(box.pose.rotation, field + ".rotation");
  for (int axis = 0; axis < Dim; ++axis) {
    require_length(box.half[axis], fmt::format("{}.half[{}]", field, axis));
  }
}

template <int Dim>
void check_kind(const BallPiece<Dim>& ball, const std::string& field) {
  require_finite<Dim>(ball.centre, field + ".centre");
  require_length(ball.radius, field + ".radius");
}

template <int Dim>
void check_kind(const CapsulePiece<Dim>& capsule, const std::string& field) {
  require_finite<Dim>(capsule.a, field + ".a");
  require_finite<Dim>(capsule.b, field + ".b");
  require_length(capsule.radius, field + ".radius");
  require_length((capsule.b - capsule.a).norm(), field + " distance from a to b");
}

template <int Dim>
void check_kind(const HullPiece<Dim>& hull, const std::string& field) {
  for (std::size_t i = 0; i < hull.corners.size(); ++i) {
    require_finite<Dim>(hull.corners[i], fmt::format("{}.corners[{}]", field, i));
  }
  check_corners(hull.corners, field + ".corners");
}

}  // namespace

template <int Dim>
void check_piece(const Piece<Dim>& piece, const std::string& field) {
  std::visit([&](const auto& kind) { check_kind(kind, field); }, piece);
}

template <int Dim>
void check_rotation(const Rotation<Dim>& rotation, const std::string& field) {
  if constexpr (Dim == 2) {
    require(std::isfinite(rotation.angle()), field, rotation.angle(), "must be finite");
  } else {
    require(std::abs(rotation.norm() - 1.0) < 1e-6, field + " length", rotation.norm(), "must be finite and 1");
  }
}

void check_material(const Material& material, const std::string& field) {
  check_fields(material, density_field, field);
  check_fields(material, surface_fields, field);
}

template void check_piece(const Piece<2>&, const std::string&);
template void check_piece(const Piece<3>&, const std::string&);
template void check_rotation<2>(const Rotation<2>&, const std::string&);
template void check_rotation<3>(const Rotation<3>&, const std::string&);

}  // namespace talus

#include "common/shape/check_piece.h"

#include <fmt/format.h>

#include "common/math/require.h"
#include "common/shape/piece_width.h"

namespace talus {
namespace {

constexpr int most_corners = 8;    // of a convex polygon: Box2D's limit (b2_maxPolygonVertices)
constexpr double flatness = 1e-6;  // a hull thinner than this share of its length has no volume to compute with

template <int Dim>
void require_finite(const Vec<Dim>& point, const std::string& field) {
  for (int axis = 0; axis < Dim; ++axis) {
    require(std::isfinite(point[axis]), fmt::format("{}[{}]", field, axis), point[axis], "must be finite");
  }
}

void require_length(double length, const std::string& field) {
  require(std::isfinite(length) && length > 0.0, field, length, "must be finite and above 0 m");
}

template <int Dim>
double diagonal(const std::vector<Vec<Dim>>& corners) {
  Box<Dim> bounds;
  for (const Vec<Dim>& corner : corners) {
    bounds.extend(corner);
  }
  return bounds.diagonal().norm();
}

// Every corner lies to the left of every edge that it does not belong to: strictly convex, counter-clockwise, no corner
// twice, and not wound around more than once.
void require_convex(const std::vector<Vec2>& corners, const std::string& field) {
  const double least = flatness * diagonal<2>(corners);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    for (std::size_t other = 0; other < corners.size(); ++other) {
      const bool apart =
          other == i || other == next || distance_from_line(corners[other], corners[i], corners[next]) > least;
      require(apart, fmt::format("{}[{}]", field, other),
              fmt::format("({}, {})", corners[other].x(), corners[other].y()),
              "must be a corner of a convex polygon given counter-clockwise, no three corners on one line");
    }
  }
}

void check_corners(const std::vector<Vec2>& corners, const std::string& field) {
  const int count = static_cast<int>(corners.size());
  require(count >= 3 && count <= most_corners, field + ".size", count, "must be 3 to 8 corners");
  require_convex(corners, field);
}

void check_corners(const std::vector<Vec3>& corners, const std::string& field) {
  require(corners.size() >= 4, field + ".size", static_cast<double>(corners.size()), "must be 4 corners or more");
  const double thickness = smallest_width<3>(HullPiece<3>{corners});
  require(thickness > flatness * diagonal<3>(corners), field + " thickness", thickness,
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
  require(material.density > 0.0 && material.density <= 1e6, field + ".density", material.density,
          "must be above 0 and at most 1e6 kg/m^3 (kg/m^2 in 2D)");
  require(material.friction >= 0.0 && material.friction <= 1e3, field + ".friction", material.friction,
          "must be in [0, 1000]");
  require(material.restitution >= 0.0 && material.restitution <= 1.0, field + ".restitution", material.restitution,
          "must be in [0, 1]");
}

template void check_piece(const Piece<2>&, const std::string&);
template void check_piece(const Piece<3>&, const std::string&);
template void check_rotation<2>(const Rotation<2>&, const std::string&);
template void check_rotation<3>(const Rotation<3>&, const std::string&);

}  // namespace talus

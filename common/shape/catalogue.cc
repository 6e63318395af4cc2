#include "common/shape/catalogue.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "common/math/random.h"
#include "common/math/require.h"
#include "common/shape/convex_hull.h"
#include "common/shape/polygon.h"
#include "common/shape/polygon_partition.h"
#include "common/shape/shape_fields.h"

namespace talus {
namespace {

// A box from its place along x and z; in 3D as deep as `depth`, half of it to each side.
template <int Dim>
BoxPiece<Dim> box_between(const Vec2& low, const Vec2& high, double depth) {
  const Vec2 middle = (low + high) / 2.0;
  const Vec2 half = (high - low) / 2.0;
  BoxPiece<Dim> box;
  if constexpr (Dim == 2) {
    box.pose.position = middle;
    box.half = half;
  } else {
    box.pose.position = {middle.x(), 0.0, middle.y()};
    box.half = {half.x(), depth / 2.0, half.y()};
  }
  return box;
}

std::vector<Vec2> arranged(std::span<const Vec2> corners) {
  std::vector<Vec2> result(corners.begin(), corners.end());
  if (signed_area(corners) < 0.0) std::reverse(result.begin(), result.end());
  return result;
}

// Only the points that are corners of the hull, in the order in which they were given.
std::vector<Vec3> arranged(std::span<const Vec3> points) {
  std::set<int> used;
  for (const std::vector<int>& face : convex_hull_faces(points)) used.insert(face.begin(), face.end());
  std::vector<Vec3> result;
  for (const int index : used) result.push_back(points[index]);
  return result;
}

void check_ring(const RingParams& ring) {
  require(std::isfinite(ring.inner_radius) && ring.inner_radius > 0.0, "ring.inner_radius", ring.inner_radius,
          "must be finite and above 0 m");
  require(std::isfinite(ring.outer_radius) && ring.outer_radius > ring.inner_radius, "ring.outer_radius",
          ring.outer_radius, "must be finite and above the inner radius");
  require(ring.parts >= 3 && ring.parts <= 64, "ring.parts", ring.parts, "must be in 3..64");
  const int corners = ring.section_corners;
  require(corners == 4 || corners == 6 || corners == 8, "ring.section_corners", corners, "must be 4, 6 or 8");
  require(std::isfinite(ring.depth) && ring.depth >= 0.0, "ring.depth", ring.depth, "must be finite and at least 0 m");
}

Vec2 on_circle(double radius, double angle) { return radius * Vec2(std::cos(angle), std::sin(angle)); }

HullPiece<2> flat_part(const RingParams& ring, double from, double to) {
  return {{on_circle(ring.inner_radius, from), on_circle(ring.outer_radius, from), on_circle(ring.outer_radius, to),
           on_circle(ring.inner_radius, to)}};
}

/// Evenly spread over the unit sphere: on a spiral, each the same height above the one before (Fibonacci lattice).
std::vector<Vec3> points_on_sphere(int count) {
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const Vec2 around = on_circle(std::sqrt(1.0 - z * z), golden_angle * i);
    points.emplace_back(around.x(), around.y(), z);
  }
  return points;
}

/// Leaves out corners that are not convex: of corners in order around the origin their hull is left.
void make_convex(std::vector<Vec2>& corners) {
  while (corners.size() > 3) {
    std::optional<std::size_t> bad = non_convex_corner(corners);
    if (!bad) return;
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::array near = {corners[(i + count - 1) % count], corners[i], corners[(i + 1) % count]};
      if (non_convex_corner(near)) bad = i;
    }
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(*bad));
  }
}

// The section is a regular polygon with one side on the outer and one on the inner radius, stretched to the depth.
HullPiece<3> tube_part(const RingParams& ring, double from, double to) {
  const double middle = (ring.outer_radius + ring.inner_radius) / 2.0;
  const double turn = std::numbers::pi / ring.section_corners;
  const double reach = (ring.outer_radius - ring.inner_radius) / 2.0 / std::cos(turn);
  const double highest = reach * (ring.section_corners == 6 ? 1.0 : std::cos(turn));  // 6: a corner there, else a side
  const double stretch = ring.depth > 0.0 ? ring.depth / 2.0 / highest : 1.0;
  HullPiece<3> hull;
  for (const double angle : {from, to}) {
    for (int k = 0; k < ring.section_corners; ++k) {
      const Vec2 corner = on_circle(reach, (2 * k + 1) * turn);
      const Vec2 place = on_circle(middle + corner.x(), angle);
      hull.corners.push_back({place.x(), stretch * corner.y(), place.y()});
    }
  }
  return hull;
}

}  // namespace

template <int Dim>
std::vector<Piece<Dim>> box_pieces(const Vec<Dim>& size) {
  const Piece<Dim> box = BoxPiece<Dim>{Pose<Dim>{}, size / 2.0};
  check_piece(box, "box");
  return {box};
}

template <int Dim>
std::vector<Piece<Dim>> l_pieces(const LParams& params) {
  check_fields<LParams>(params, l_fields, "l");
  require(params.arm_x > params.thickness, "l.arm_x", params.arm_x, "must be above the thickness");
  require(params.arm_z > params.thickness, "l.arm_z", params.arm_z, "must be above the thickness");
  const double t = params.thickness;
  return {box_between<Dim>({0.0, 0.0}, {params.arm_x, t}, params.depth),
          box_between<Dim>({0.0, t}, {t, params.arm_z}, params.depth)};
}

template <int Dim>
std::vector<Piece<Dim>> ball_pieces(double radius) {
  const Piece<Dim> ball = HullPiece<Dim>{{Vec<Dim>::Zero()}, radius};
  check_piece(ball, "ball");
  return {ball};
}

template <int Dim>
std::vector<Piece<Dim>> capsule_pieces(double length, double radius) {
  require(std::isfinite(length) && length > 2.0 * radius, "capsule.length", length,
          "must be finite and above twice the radius");
  const Vec<Dim> end = Vec<Dim>::Unit(0) * (length / 2.0 - radius);
  const Piece<Dim> capsule = HullPiece<Dim>{{-end, end}, radius};
  check_piece(capsule, "capsule");
  return {capsule};
}

template <int Dim>
std::vector<Piece<Dim>> cylinder_pieces(const CylinderParams& params) {
  check_fields<CylinderParams>(params, cylinder_fields, "cylinder");
  if constexpr (Dim == 2) {
    return box_pieces<2>({2.0 * params.radius, params.length});
  } else {
    std::vector<Vec3> corners;
    for (int i = 0; i < params.sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / params.sides;
      for (const double z : {-params.length / 2.0, params.length / 2.0})
        corners.emplace_back(params.radius * std::cos(angle), params.radius * std::sin(angle), z);
    }
    return hull_pieces<3>(corners);
  }
}

template <int Dim>
std::vector<Piece<Dim>> cone_pieces(const ConeParams& params) {
  check_fields<ConeParams>(params, cone_fields, "cone");
  const double half = params.height / 2.0;
  if constexpr (Dim == 2) {
    const std::vector<Vec2> corners = {{-params.radius, -half}, {params.radius, -half}, {0.0, half}};
    return hull_pieces<2>(corners);
  } else {
    std::vector<Vec3> corners = {{0.0, 0.0, half}};
    for (int i = 0; i < params.sides; ++i) {
      const Vec2 at = on_circle(params.radius, 2.0 * std::numbers::pi * i / params.sides);
      corners.emplace_back(at.x(), at.y(), -half);
    }
    return hull_pieces<3>(corners);
  }
}

template <int Dim>
std::vector<Piece<Dim>> ellipse_pieces(const EllipseParams<Dim>& params) {
  check_fields<EllipseParams<Dim>>(params, ellipse_fields<Dim>, "ellipse");
  const Vec<Dim> radii = params.size / 2.0;
  if constexpr (Dim == 2) {
    std::vector<Vec2> corners;
    for (int i = 0; i < params.corners; ++i)
      corners.emplace_back(radii.cwiseProduct(on_circle(1.0, 2.0 * std::numbers::pi * i / params.corners)));
    return polygon_pieces<2>(corners);
  } else {
    std::vector<Vec3> corners = points_on_sphere(params.corners);
    for (Vec3& corner : corners) corner = radii.cwiseProduct(corner);
    return hull_pieces<3>(corners);
  }
}

template <int Dim>
std::vector<Piece<Dim>> stone_pieces(const StoneParams& params, std::mt19937_64& random) {
  const int count = params.corners > 0 ? params.corners : (Dim == 2 ? 7 : 16);
  require(Dim == 3 || count <= static_cast<int>(most_corners), "corners", count, "must be at most 8 in 2D");
  const double across = 0.5 * params.size / std::pow(params.elongation, 1.0 / Dim);
  Vec<Dim> radii = Vec<Dim>::Constant(across);
  radii[0] = across * params.elongation;
  const auto inwards = [&] { return 1.0 - params.roughness * uniform(random); };
  if constexpr (Dim == 2) {
    std::vector<Vec2> corners;
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.6 * uniform(random)) / count;
      corners.emplace_back(radii.cwiseProduct(on_circle(inwards(), angle)));
    }
    make_convex(corners);
    return hull_pieces<2>(corners);
  } else {
    const Rotation<3> turn = uniform_rotation<3>(random);
    const double jitter = 0.6 * std::sqrt(4.0 * std::numbers::pi / count);
    std::vector<Vec3> corners;
    for (const Vec3& even : points_on_sphere(count)) {
      const Vec3 at = (turn * even + uniform_within<3>(Vec3::Constant(0.5 * jitter), random)).normalized();
      corners.emplace_back(radii.cwiseProduct(inwards() * at));
    }
    return hull_pieces<3>(corners);
  }
}

template <int Dim>
std::vector<Piece<Dim>> hull_pieces(std::span<const Vec<Dim>> corners) {
  check_corner_count<Dim>(corners.size(), "hull.corners");
  if constexpr (Dim == 3) check_piece<3>(HullPiece<3>{{corners.begin(), corners.end()}}, "hull");
  const Piece<Dim> hull = HullPiece<Dim>{arranged(corners)};
  check_piece(hull, "hull");
  return {hull};
}

template <int Dim>
std::vector<Piece<Dim>> polygon_pieces(std::span<const Vec2> corners, double depth) {
  require(std::isfinite(depth) && depth > 0.0, "polygon.depth", depth, "must be finite and above 0 m");
  std::vector<Piece<Dim>> pieces;
  for (const std::vector<Vec2>& part : convex_partition(corners)) {
    HullPiece<Dim> hull;
    if constexpr (Dim == 2) {
      hull.corners = part;
    } else {
      for (const Vec2& corner : part) {
        hull.corners.push_back({corner.x(), -depth / 2.0, corner.y()});
        hull.corners.push_back({corner.x(), depth / 2.0, corner.y()});
      }
    }
    pieces.push_back(std::move(hull));
  }
  return pieces;
}

template <int Dim>
std::vector<Piece<Dim>> ring_pieces(const RingParams& params) {
  check_ring(params);
  const double step = 2.0 * std::numbers::pi / params.parts;
  std::vector<Piece<Dim>> pieces;
  for (int k = 0; k < params.parts; ++k)
    if constexpr (Dim == 2)
      pieces.push_back(flat_part(params, k * step, (k + 1) * step));
    else
      pieces.push_back(tube_part(params, k * step, (k + 1) * step));
  return pieces;
}

template std::vector<Piece<2>> box_pieces(const Vec<2>&);
template std::vector<Piece<3>> box_pieces(const Vec<3>&);
template std::vector<Piece<2>> l_pieces(const LParams&);
template std::vector<Piece<3>> l_pieces(const LParams&);
template std::vector<Piece<2>> ball_pieces(double);
template std::vector<Piece<3>> ball_pieces(double);
template std::vector<Piece<2>> capsule_pieces(double, double);
template std::vector<Piece<3>> capsule_pieces(double, double);
template std::vector<Piece<2>> cylinder_pieces(const CylinderParams&);
template std::vector<Piece<3>> cylinder_pieces(const CylinderParams&);
template std::vector<Piece<2>> cone_pieces(const ConeParams&);
template std::vector<Piece<3>> cone_pieces(const ConeParams&);
template std::vector<Piece<2>> ellipse_pieces(const EllipseParams<2>&);
template std::vector<Piece<3>> ellipse_pieces(const EllipseParams<3>&);
template std::vector<Piece<2>> stone_pieces(const StoneParams&, std::mt19937_64&);
template std::vector<Piece<3>> stone_pieces(const StoneParams&, std::mt19937_64&);
template std::vector<Piece<2>> hull_pieces(std::span<const Vec<2>>);
template std::vector<Piece<3>> hull_pieces(std::span<const Vec<3>>);
template std::vector<Piece<2>> polygon_pieces(std::span<const Vec2>, double);
template std::vector<Piece<3>> polygon_pieces(std::span<const Vec2>, double);
template std::vector<Piece<2>> ring_pieces(const RingParams&);
template std::vector<Piece<3>> ring_pieces(const RingParams&);

}  // namespace talus

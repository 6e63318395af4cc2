// The ring of the catalogue.

#include <numbers>

#include "common/math/require.h"
#include "common/shape/catalogue.h"

namespace talus {
namespace {

void check(const RingParams& ring) {
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
std::vector<Piece<Dim>> ring_pieces(const RingParams& params) {
  check(params);
  const double step = 2.0 * std::numbers::pi / params.parts;
  std::vector<Piece<Dim>> pieces;
  for (int k = 0; k < params.parts; ++k) {
    if constexpr (Dim == 2) {
      pieces.push_back(flat_part(params, k * step, (k + 1) * step));
    } else {
      pieces.push_back(tube_part(params, k * step, (k + 1) * step));
    }
  }
  return pieces;
}

template std::vector<Piece<2>> ring_pieces(const RingParams&);
template std::vector<Piece<3>> ring_pieces(const RingParams&);

}  // namespace talus

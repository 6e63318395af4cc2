#include "tools/mesh/decomposition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "common/math/require.h"
#include "common/mesh/parts_volume.h"
#include "common/shape/piece.h"
#include "tools/mesh/convex_parts.h"

namespace talus {
namespace {

constexpr double convexity_tolerance = 1e-3;  // share by which the hull's volume may differ from a convex mesh's

std::vector<Mesh> without_thin(const std::vector<Mesh>& parts, double least_width) {
  std::vector<Mesh> thick;
  for (const Mesh& part : parts)
    if (smallest_width<3>(HullPiece<3>{part.corners}) >= least_width) thick.push_back(part);
  return thick;
}

// Without its thin parts if these are not needed for the volume.
Decomposition attempt(const Mesh& mesh, const ConvexPartsParams& params) {
  Decomposition all{convex_parts(mesh, params), 0.0, params};
  all.ratio = volume_ratio(all.parts, mesh);
  Decomposition thick{without_thin(all.parts, thinnest_part * longest_side(mesh)), 0.0, params};
  thick.ratio = volume_ratio(thick.parts, mesh);
  return fills_mesh(all.ratio) && !fills_mesh(thick.ratio) ? all : thick;
}

// The number of parts by bisection: more parts follow the surface closer, and lose more of the volume within.
Decomposition best_number_of_parts(const Mesh& mesh, ConvexPartsParams params) {
  int fewest = 1;
  int most = most_parts;
  std::optional<Decomposition> best;
  while (fewest <= most && !(best && fills_mesh(best->ratio))) {
    const Decomposition next = attempt(mesh, params);
    (next.ratio < 1.0 ? most : fewest) = next.ratio < 1.0 ? params.parts - 1 : params.parts + 1;
    if (!best || std::abs(next.ratio - 1.0) < std::abs(best->ratio - 1.0)) best = next;
    params.parts = (fewest + most) / 2;
  }
  return *best;
}

}  // namespace

double least_longest_side(const Mesh& mesh, std::span<const Mesh> parts) {
  double thinnest = longest_side(mesh);
  for (const Mesh& part : parts) thinnest = std::min(thinnest, smallest_width<3>(HullPiece<3>{part.corners}));
  const double side = thinnest_piece_in_space * longest_side(mesh) / thinnest;
  const double digit = std::pow(10.0, std::floor(std::log10(side)) - 2.0);
  return std::ceil(side / digit) * digit;
}

Decomposition decomposed(const Mesh& mesh, const ConvexPartsParams& params) {
  require(mesh.triangles.size() <= most_triangles, "mesh triangles", static_cast<double>(mesh.triangles.size()),
          "must be at most 2500 to be decomposed; simplify the mesh first");
  const Mesh hull = hull_mesh(mesh.corners);
  if (fills_mesh(moments(hull).volume / moments(mesh).volume, convexity_tolerance)) {
    const bool few = std::ssize(hull.corners) <= params.corners;
    Decomposition one{{few ? hull : coarser_hull(hull, params.corners)}, 0.0, params};
    one.ratio = moments(one.parts[0]).volume / moments(mesh).volume;
    return one;
  }
  Decomposition best = best_number_of_parts(mesh, params);
  if (!fills_mesh(best.ratio) && params.corners < most_part_corners) {
    Decomposition finer = best_number_of_parts(mesh, {params.parts, most_part_corners});
    best = std::abs(finer.ratio - 1.0) < std::abs(best.ratio - 1.0) ? finer : best;
  }
  if (!fills_mesh(best.ratio)) {
    throw std::runtime_error(
        fmt::format("the parts' volume is {:.3g} times the mesh's at best, with {} parts; it must be within {:.0f} %. "
                    "Nothing was written. A mesh of more and smaller triangles, without shells that overlap, may help",
                    best.ratio, best.parts.size(), 100.0 * parts_tolerance));
  }
  return best;
}

}  // namespace talus

#pragma once
// Convex parts whose volume is that of the mesh.

#include <span>
#include <vector>

#include "common/world/world_description.h"
#include "tools/mesh/convex_parts.h"

namespace talus {

/// The thinnest part that a scene accepts at the default longest side of 1 m, as a share of the mesh's longest side.
constexpr double thinnest_part = thinnest_piece_in_space;

/// Largest mesh that is decomposed: HACD's time grows with the square of the number of triangles.
constexpr std::size_t most_triangles = 2500;

/// The least `longest_side` [m] at which a scene accepts the parts, rounded up to three digits.
double least_longest_side(const Mesh& mesh, std::span<const Mesh> parts);

struct Decomposition {
  std::vector<Mesh> parts;
  double ratio = 0.0;        // volume_ratio() of the parts
  ConvexPartsParams params;  // with which they were made
};

/// Parts whose union has the mesh's volume within parts_tolerance: of a convex mesh one, its hull. Other meshes are cut
/// with `params` first; while the volume is too small with fewer parts, while it is too large with more, then again
/// with most_part_corners. Parts thinner than thinnest_part are left out where the volume allows it. Throws
/// std::runtime_error with the best ratio when no attempt succeeds, std::invalid_argument as convex_parts() does
/// and on a mesh of more than most_triangles.
Decomposition decomposed(const Mesh& mesh, const ConvexPartsParams& params);

}  // namespace talus

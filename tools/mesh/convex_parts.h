#pragma once
// A mesh cut into convex parts, once, before any run: what a scene in 3D needs of a mesh file.

#include <span>
#include <vector>

#include "common/mesh/mesh.h"

namespace talus {

/// The convex hull of points, outside out, with no corner inside an edge or a face; without triangles where the points
/// span no volume.
Mesh hull_mesh(std::span<const Vec3> points);

/// A hull within `hull`, made of few of its corners: the farthest outside is added until there are `corners` of them
/// and the volume lies within parts_tolerance of that of `hull`, or until there are most_part_corners.
Mesh coarser_hull(const Mesh& hull, int corners);

constexpr int most_parts = 64;
constexpr int most_part_corners = 128;

struct ConvexPartsParams {
  /// Largest number of parts, 1 to most_parts. Few fill hollows, many cost time in each contact of each body.
  int parts = 8;
  /// Largest number of corners of a part, 4 to most_part_corners. Few cut bumps off, many cost time in each contact.
  int corners = 24;
};

/// Convex parts of a mesh that repaired() has passed, by HACD (Mamou 2009). They cover it nearly and overlap a little:
/// the Stanford bunny, whose hull has 1.56 times its volume, is covered to 0.97 of it by 8 parts of 32 corners whose
/// volumes add up to 1.09. Takes seconds for thousands of triangles. The same mesh gives the same parts.
/// Throws std::invalid_argument on parameters out of range.
std::vector<Mesh> convex_parts(const Mesh& mesh, const ConvexPartsParams& params);

}  // namespace talus

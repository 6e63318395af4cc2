#pragma once
// Convex hulls as meshes.

#include <span>

#include "common/mesh/mesh.h"

namespace talus {

/// The convex hull of points, outside out, with no corner inside an edge or a face; without triangles where the points
/// span no volume.
Mesh hull_mesh(std::span<const Vec3> points);

/// A hull within `hull`, made of few of its corners: the farthest outside is added until there are `corners` of them
/// and the volume lies within parts_tolerance of that of `hull`, or until there are most_part_corners.
Mesh coarser_hull(const Mesh& hull, int corners);

}  // namespace talus

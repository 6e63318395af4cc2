#pragma once
// A mesh's outline seen along y: what stands for it in the plane.

#include <vector>

#include "common/mesh/mesh.h"

namespace talus {

/// The outer outline of the mesh projected onto the x-z plane, counter-clockwise: of the largest region, without holes.
/// Corners are left out as long as the outline strays from the true one by at most `detail` [m], > 0. Finer costs
/// pieces: the Stanford bunny, 1 m long, is cut into 4 convex ones at 0.05 m, 8 at 0.02 m, 18 at 0.005 m. Throws
/// std::invalid_argument on a detail that is not positive or too coarse to leave an area.
std::vector<Vec2> silhouette(const Mesh& mesh, double detail);

}  // namespace talus

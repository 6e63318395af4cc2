#pragma once
// A mesh's outline seen along y: what stands for it in the plane.

#include <vector>

#include "common/mesh/mesh.h"

namespace talus {

/// The outer outline of the mesh projected onto the x-z plane, counter-clockwise: of the largest region, without holes.
/// Corners are left out so that the line strays by about `detail` [m] at most, > 0: half of that gives some 1.4 times
/// as many corners, and pieces in proportion. Throws std::invalid_argument on a detail that is not positive or too
/// coarse to leave an area.
std::vector<Vec2> silhouette(const Mesh& mesh, double detail);

}  // namespace talus

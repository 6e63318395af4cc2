#pragma once
// Closed surfaces made of triangles, as modelling tools write them.

#include <array>
#include <cstdint>
#include <vector>

#include "common/shape/moments.h"

namespace talus {

struct Mesh {
  std::vector<Vec3> corners;                  // [m], once scaled
  std::vector<std::array<int, 3>> triangles;  // corners counter-clockwise seen from outside
};

/// Exact for a mesh that repaired() has passed.
Moments<3> moments(const Mesh& mesh);

/// FNV-1a over the bits of corners and triangles: equal hashes mean equal meshes.
std::uint64_t content_hash(const Mesh& mesh);

}  // namespace talus

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

/// The axis-aligned box around all corners. Throws std::invalid_argument on a corner that is not finite.
Box<3> bounds_of(const Mesh& mesh);
inline double longest_side(const Mesh& mesh) { return bounds_of(mesh).sizes().maxCoeff(); }

/// Mends what is harmless: merges corners closer than about a millionth of the mesh's length, drops triangles that are
/// then without area or there twice, drops corners that no triangle uses, and turns every connected part so that its
/// outside is outside. Overlapping parts count twice; hollows become solid.
/// Closed pieces may touch each other at corners, edges and faces; each stays a piece of its own.
/// Throws std::invalid_argument with count and place where the surface is not closed, where more than two triangles
/// meet in an edge that are not of closed pieces, where it has but one side (a Moebius strip), and where it encloses no
/// volume.
Mesh repaired(const Mesh& mesh);

}  // namespace talus

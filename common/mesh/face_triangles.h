#pragma once
// A mesh's faces cut into triangles.

#include <array>
#include <span>
#include <vector>

#include "common/math/vector.h"

namespace talus {

/// Cuts a face, given as indices of corners in order, into triangles without new corners, by clipping ears. The face
/// may be concave; it should be nearly flat and not cross itself (else its triangles may overlap). Every edge of the
/// face, collinear ones too, is the edge of one triangle. Time grows with the square of the corners.
std::vector<std::array<int, 3>> face_triangles(std::span<const int> face, std::span<const Vec3> corners);

}  // namespace talus

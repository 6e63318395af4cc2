#pragma once
// The surface of a shape as polygons: what pictures and viewers draw.

#include <vector>

#include "common/shape/shape.h"

namespace talus {

/// A closed loop of corners [m], the last joined to the first.
template <int Dim>
using Loop = std::vector<Vec<Dim>>;

/// One convex loop for each piece of the shape, in order of the pieces, counter-clockwise, in the shape's own axes.
/// Discs and the ends of capsules have corners on the curve, `segments` of them for a full turn: a multiple of 4, else
/// std::invalid_argument.
std::vector<Loop<2>> outlines(const Shape<2>& shape, int segments);

/// The planar faces of all pieces, counter-clockwise seen from outside, in the shape's own axes. Coplanar triangles of
/// a hull are one face. Balls and the ends of capsules have corners on the surface, `segments` around and half as many
/// steps from pole to pole: a multiple of 4, else std::invalid_argument.
std::vector<Loop<3>> faces(const Shape<3>& shape, int segments);

}  // namespace talus

#pragma once
// How thin a piece is.

#include "common/shape/shape.h"

namespace talus {

/// The least distance between two parallel lines or planes that hold the piece [m]. For hulls in 3D only planes along
/// a face are tried. What engines need to be large beside their contact skin.
template <int Dim>
double smallest_width(const Piece<Dim>& piece);

}  // namespace talus

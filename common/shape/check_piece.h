#pragma once
// What a piece must be like, whatever the engine.

#include <string>

#include "common/shape/shape.h"

namespace talus {

/// Throws std::invalid_argument with field (beginning with `field`), value and rule on a non-finite value, on a size
/// that is not positive, and on corners that are too few, too many (2D), on one line or in one plane, or not convex.
template <int Dim>
void check_piece(const Piece<Dim>& piece, const std::string& field);

/// Throws unless the rotation is finite and, in 3D, its quaternion of length 1.
template <int Dim>
void check_rotation(const Rotation<Dim>& rotation, const std::string& field);

/// Throws on a density, friction or restitution outside its range.
void check_material(const Material& material, const std::string& field);

}  // namespace talus

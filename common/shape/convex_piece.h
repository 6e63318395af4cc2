#pragma once
// A piece as a convex polytope with its corners, edges and faces, grown by a radius.

#include <array>
#include <vector>

#include "common/shape/shape.h"

namespace talus {

/// All points within `radius` of the hull of `corners`. A box or hull has radius 0; a ball is one corner, a capsule
/// two.
template <int Dim>
struct ConvexPiece {
  std::vector<Vec<Dim>> corners;              // [m]
  double radius = 0.0;                        // [m]
  std::vector<std::array<int, 2>> edges;      // pairs of corners; a ball has one edge from its corner to itself
  std::vector<std::array<int, 3>> triangles;  // 3D: the faces
  std::vector<Vec<Dim>> normals;              // unit, of faces (in 2D of edges); one for each pair of parallel faces
  std::vector<Vec<Dim>> directions;           // 3D: unit, along edges; one for each set of parallel edges

  Box<Dim> bounds() const;
};

/// In the shape's axes.
template <int Dim>
ConvexPiece<Dim> convex_piece(const Piece<Dim>& piece);

/// All pieces of a shape.
template <int Dim>
std::vector<ConvexPiece<Dim>> convex_pieces(const Shape<Dim>& shape);
/// The same with the shape at a pose.
template <int Dim>
std::vector<ConvexPiece<Dim>> convex_pieces_at(const Shape<Dim>& shape, const Pose<Dim>& pose);

template <int Dim>
ConvexPiece<Dim> moved(ConvexPiece<Dim> piece, const Pose<Dim>& pose);

}  // namespace talus

#include "common/shape/convex_piece.h"

#include <algorithm>

#include "common/shape/convex_hull.h"

namespace talus {
namespace {

/// Adds a unit direction unless one along the same line is there: axes are tried both ways.
template <int Dim>
void add_line(std::vector<Vec<Dim>>& lines, const Vec<Dim>& direction) {
  const Vec<Dim> unit = direction.normalized();
  const bool known = std::any_of(lines.begin(), lines.end(),
                                 [&](const Vec<Dim>& line) { return (unit - line.dot(unit) * line).norm() < 1e-9; });
  if (!known) lines.push_back(unit);
}

void add_faces(ConvexPiece<2>& piece) {
  const int count = static_cast<int>(piece.corners.size());
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    if (count > 2 || i == 0) piece.edges.push_back({i, next});
    const Vec2 side = piece.corners[next] - piece.corners[i];
    if (count > 1) add_line<2>(piece.normals, Vec2(side.y(), -side.x()));
  }
}

void add_faces(ConvexPiece<3>& piece) {
  const auto corner = [&](int i) -> const Vec3& { return piece.corners[i]; };
  if (piece.corners.size() <= 2) {
    piece.edges.push_back({0, static_cast<int>(piece.corners.size()) - 1});
  } else {
    for (const std::vector<int>& face : convex_hull_faces(piece.corners)) {
      Vec3 normal = Vec3::Zero();  // twice the area, whatever the face's form
      for (std::size_t i = 0; i < face.size(); ++i) {
        const int from = face[i];
        const int to = face[(i + 1) % face.size()];
        normal += (corner(from) - corner(face[0])).cross(corner(to) - corner(face[0]));
        if (from < to) piece.edges.push_back({from, to});  // the neighbouring face has it the other way round
        if (i >= 1 && i + 1 < face.size()) piece.triangles.push_back({face[0], from, to});
      }
      add_line<3>(piece.normals, normal);
    }
  }
  for (const auto& [from, to] : piece.edges)
    if (from != to) add_line<3>(piece.directions, corner(to) - corner(from));
}

}  // namespace

template <int Dim>
Box<Dim> ConvexPiece<Dim>::bounds() const {
  Box<Dim> box;
  for (const Vec<Dim>& corner : corners) box.extend(corner);
  const Vec<Dim> margin = Vec<Dim>::Constant(radius);
  return {box.min() - margin, box.max() + margin};
}

template <int Dim>
ConvexPiece<Dim> convex_piece(const Piece<Dim>& piece) {
  HullPiece<Dim> hull = as_hull(piece);
  ConvexPiece<Dim> convex;
  convex.corners = std::move(hull.corners);
  convex.radius = hull.radius;
  add_faces(convex);
  return convex;
}

template <int Dim>
std::vector<ConvexPiece<Dim>> convex_pieces(const Shape<Dim>& shape) {
  std::vector<ConvexPiece<Dim>> pieces;
  pieces.reserve(shape.pieces.size());
  for (const Piece<Dim>& piece : shape.pieces) pieces.push_back(convex_piece<Dim>(piece));
  return pieces;
}

template <int Dim>
ConvexPiece<Dim> moved(ConvexPiece<Dim> piece, const Pose<Dim>& pose) {
  for (Vec<Dim>& corner : piece.corners) corner = pose * corner;
  for (Vec<Dim>& normal : piece.normals) normal = pose.rotation * normal;
  for (Vec<Dim>& direction : piece.directions) direction = pose.rotation * direction;
  return piece;
}

template <int Dim>
std::vector<ConvexPiece<Dim>> convex_pieces_at(const Shape<Dim>& shape, const Pose<Dim>& pose) {
  std::vector<ConvexPiece<Dim>> pieces = convex_pieces(shape);
  for (ConvexPiece<Dim>& piece : pieces) piece = moved(std::move(piece), pose);
  return pieces;
}

template struct ConvexPiece<2>;
template struct ConvexPiece<3>;
template ConvexPiece<2> convex_piece(const Piece<2>&);
template ConvexPiece<3> convex_piece(const Piece<3>&);
template std::vector<ConvexPiece<2>> convex_pieces(const Shape<2>&);
template std::vector<ConvexPiece<3>> convex_pieces(const Shape<3>&);
template std::vector<ConvexPiece<2>> convex_pieces_at(const Shape<2>&, const Pose<2>&);
template std::vector<ConvexPiece<3>> convex_pieces_at(const Shape<3>&, const Pose<3>&);
template ConvexPiece<2> moved(ConvexPiece<2>, const Pose<2>&);
template ConvexPiece<3> moved(ConvexPiece<3>, const Pose<3>&);

}  // namespace talus

#include "sim3d/bullet/placed_pieces.h"

#include <algorithm>
#include <limits>

namespace talus::bullet {

void PlacedBody::place(const btCompoundShape& shape, const btTransform& body) {
  pieces.resize(shape.getNumChildShapes());
  for (int i = 0; i < shape.getNumChildShapes(); ++i) {
    WorldPiece& piece = pieces[i];
    piece.shape = shape.getChildShape(i);
    piece.place = body * shape.getChildTransform(i);
    btVector3 low;
    btVector3 high;
    piece.shape->getAabb(piece.place, low, high);
    piece.box = {lanes(low), lanes(high)};
    box = i == 0 ? piece.box : PieceBox{smaller(box.low, piece.box.low), larger(box.high, piece.box.high)};
  }
}

bool pieces_overlap(const PlacedBody& a, const PlacedBody& b) {
  if (!overlap(a.box, b.box)) return false;
  return std::ranges::any_of(a.pieces, [&b](const WorldPiece& piece) {
    return overlap(piece.box, b.box) &&
           std::ranges::any_of(b.pieces, [&piece](const WorldPiece& other) { return overlap(piece.box, other.box); });
  });
}

void PlacedPieces::grow(std::int32_t slot) {
  if (std::ssize(slots_) <= slot) slots_.resize(slot + 1);
}

PlacedBody& PlacedPieces::obstacle(int index) {
  const int number = -index;
  if (std::ssize(obstacles_) <= number) obstacles_.resize(number + 1);
  return obstacles_[number];
}

void PlacedPieces::update(PlacedBody& placed, const btCollisionObject& body) const {
  placed.place(*static_cast<const btCompoundShape*>(body.getCollisionShape()), body.getWorldTransform());
  placed.known_until = body.isStaticObject() ? std::numeric_limits<std::int64_t>::max() : step_;
}

}  // namespace talus::bullet

#pragma once
// Where the pieces of bodies are.

#include <btBulletCollisionCommon.h>

#include <cstdint>
#include <vector>

#include "sim3d/bullet/lanes.h"

namespace talus::bullet {

/// A bounding box in the world's axes [m]; fourth lanes mean nothing.
struct PieceBox {
  Lanes low;
  Lanes high;
};

/// As TestAabbAgainstAabb2: also where a number is none.
inline bool overlap(const PieceBox& a, const PieceBox& b) { return none_above(a.low, b.high, b.low, a.high); }

struct WorldPiece {
  btTransform place;
  PieceBox box = {splat(0), splat(0)};
  const btCollisionShape* shape = nullptr;
};

/// The pieces of a compound shape where its body is, and a box around all of them.
struct alignas(64) PlacedBody {
  PieceBox box = {splat(0), splat(0)};
  std::int64_t known_until = -1;  // step
  std::vector<WorldPiece> pieces;

  void place(const btCompoundShape& shape, const btTransform& body);
};

/// Whether any piece of one overlaps any of the other, by their boxes.
bool pieces_overlap(const PlacedBody& a, const PlacedBody& b);

/// Replaces what btCompoundCompoundCollisionAlgorithm computes in each call for each pair of pieces: transform and
/// bounding box of both. Here a moving body's pieces are placed once a step, those of one that does not move once in
/// its life. Bodies with pairs are identified by a slot (PairCache), obstacles by their index.
class PlacedPieces {
 public:
  /// To be called at the start of each collision detection.
  void start_step() { ++step_; }

  /// Makes slots up to this one.
  void grow(std::int32_t slot);

  /// The slot's body has changed, begins or ceases to move.
  void forget(std::int32_t slot) { slots_[slot].known_until = -1; }
  /// The obstacle stands elsewhere.
  void forget_obstacle(int index) { obstacle(index).known_until = -1; }

  /// The pieces of a body with a compound shape. `slot` -1: an obstacle.
  const PlacedBody& of(std::int32_t slot, const btCollisionObject& body) {
    PlacedBody& placed = slot >= 0 ? slots_[slot] : obstacle(body.getUserIndex());
    if (placed.known_until < step_) update(placed, body);
    return placed;
  }

  /// What is known of the slot's body now; null if it must be placed first.
  const PlacedBody* known(std::int32_t slot) const {
    const PlacedBody& placed = slots_[slot];
    return placed.known_until < step_ ? nullptr : &placed;
  }

  /// The same of an obstacle.
  const PlacedBody* known_obstacle(int index) const {
    const std::size_t number = -index;
    return number < obstacles_.size() && obstacles_[number].known_until >= step_ ? &obstacles_[number] : nullptr;
  }

  void fetch(std::int32_t slot) const { __builtin_prefetch(&slots_[slot]); }

 private:
  PlacedBody& obstacle(int index);
  void update(PlacedBody& placed, const btCollisionObject& body) const;

  std::int64_t step_ = 0;
  std::vector<PlacedBody> slots_;
  std::vector<PlacedBody> obstacles_;
};

}  // namespace talus::bullet

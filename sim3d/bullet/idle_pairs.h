#pragma once
// Pairs of bodies whose pieces are apart.

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <cstdint>

#include "sim3d/bullet/placed_pieces.h"

namespace talus::bullet {

/// The slots of a pair's two bodies, kept in the pair itself while none of their pieces meet: in the field
/// m_internalInfo1, which Bullet 3.24 carries along and never reads. As long as the boxes of their pieces do not
/// overlap, working on the pair would change nothing, and neither its algorithm nor its bodies need be fetched.
struct IdleMark {
  std::int32_t first;
  std::int32_t second;

  static bool is_set(const btBroadphasePair& pair) { return (bits_of(pair) & 1) != 0; }
  static void clear(btBroadphasePair& pair) { pair.m_internalInfo1 = nullptr; }

  /// Not idle, and its algorithm is a CompoundPair.
  static bool is_compound(const btBroadphasePair& pair) { return bits_of(pair) == compound; }
  static void set_compound(btBroadphasePair& pair) { pair.m_internalInfo1 = reinterpret_cast<void*>(compound); }

  static IdleMark of(const btBroadphasePair& pair) {
    const std::uint64_t bits = bits_of(pair);
    return {static_cast<std::int32_t>(bits >> 32), static_cast<std::int32_t>((bits & 0xffffffff) >> 1)};
  }

  /// Both slots must exist.
  void set(btBroadphasePair& pair) const {
    const std::uint64_t bits = (static_cast<std::uint64_t>(first) << 32) | (static_cast<std::uint64_t>(second) << 1);
    pair.m_internalInfo1 = reinterpret_cast<void*>(bits | 1);
  }

 private:
  static constexpr std::uintptr_t compound = 2;
  static std::uintptr_t bits_of(const btBroadphasePair& pair) {
    return reinterpret_cast<std::uintptr_t>(pair.m_internalInfo1);
  }
};

}  // namespace talus::bullet

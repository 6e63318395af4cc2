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

  static bool is_set(const btBroadphasePair& pair) { return pair.m_internalInfo1 != nullptr; }
  static void clear(btBroadphasePair& pair) { pair.m_internalInfo1 = nullptr; }

  static IdleMark of(const btBroadphasePair& pair) {
    const std::uint64_t bits = reinterpret_cast<std::uintptr_t>(pair.m_internalInfo1);
    return {static_cast<std::int32_t>(bits >> 32), static_cast<std::int32_t>((bits & 0xffffffff) >> 1)};
  }

  /// Both slots must exist. Where a pointer is too short for two slots, no pair is idle.
  void set(btBroadphasePair& pair) const {
    if constexpr (sizeof(void*) == 8) {
      const std::uint64_t bits = (static_cast<std::uint64_t>(first) << 32) | (static_cast<std::uint64_t>(second) << 1);
      pair.m_internalInfo1 = reinterpret_cast<void*>(static_cast<std::uintptr_t>(bits | 1));
    }
  }
};

}  // namespace talus::bullet

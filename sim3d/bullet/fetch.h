#pragma once
// Objects of Bullet brought into the cache before they are read: they lie scattered in memory.

#include <btBulletDynamicsCommon.h>

#include <cstddef>

namespace talus::bullet {

/// All lines of memory of an object.
template <typename T>
void fetch(const T& object) {
  const auto* memory = reinterpret_cast<const char*>(&object);
  for (std::size_t at = 0; at < sizeof(T); at += 64) __builtin_prefetch(memory + at);
}

/// The last bytes of a manifold, which hold its bodies and the number of its points.
inline void fetch_head(const btPersistentManifold& manifold) {
  const char* end = reinterpret_cast<const char*>(&manifold + 1);
  __builtin_prefetch(end - 64);
  __builtin_prefetch(end - 1);
}

}  // namespace talus::bullet

#include "common/mesh/mesh.h"

#include <bit>

namespace talus {

Moments<3> moments(const Mesh& mesh) { return moments_within<3>(mesh.corners, mesh.triangles); }

std::uint64_t content_hash(const Mesh& mesh) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      hash = (hash ^ ((word >> (8 * byte)) & 0xffu)) * 0x100000001b3u;
    }
  };
  for (const Vec3& corner : mesh.corners) {
    for (const double coordinate : corner) {
      add(std::bit_cast<std::uint64_t>(coordinate));
    }
  }
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) {
      add(static_cast<std::uint64_t>(corner));
    }
  }
  return hash;
}

}  // namespace talus

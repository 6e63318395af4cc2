#include "common/mesh/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>

#include "common/math/require.h"
#include "common/shape/polygon.h"

namespace talus {

Moments<3> moments(const Mesh& mesh) { return moments_within<3>(mesh.corners, mesh.triangles); }

std::uint64_t content_hash(const Mesh& mesh) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ ((word >> (8 * byte)) & 0xffu)) * 0x100000001b3u;
  };
  for (const Vec3& corner : mesh.corners)
    for (const double coordinate : corner) add(std::bit_cast<std::uint64_t>(coordinate));
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle) add(static_cast<std::uint64_t>(corner));
  return hash;
}

namespace {

using Triangle = std::array<int, 3>;

Box<3> bounds_of(const Mesh& mesh) {
  Box<3> bounds;
  for (const Vec3& corner : mesh.corners) {
    require(corner.allFinite(), "mesh corner", fmt::format("({}, {}, {})", corner.x(), corner.y(), corner.z()),
            "must be finite");
    bounds.extend(corner);
  }
  return bounds;
}

// The smallest number first and the direction kept: equal for triangles that are the same.
Triangle canonical(Triangle triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

// Corners that fall on the same point of a fine grid become one; triangles that lose an edge by it go.
Mesh merged(const Mesh& mesh) {
  const double grid = flatness * bounds_of(mesh).diagonal().norm();
  const int count = static_cast<int>(mesh.corners.size());
  Mesh result;
  std::map<std::array<double, 3>, int> number_at;
  std::set<Triangle> seen;
  for (const Triangle& triangle : mesh.triangles) {
    Triangle renumbered = {};
    for (std::size_t k = 0; k < 3; ++k) {
      require(triangle[k] >= 0 && triangle[k] < count, "mesh triangle's corner", triangle[k],
              "must be the number of a corner");
      const Vec3& corner = mesh.corners[triangle[k]];
      const std::array<double, 3> place = {std::round(corner.x() / grid), std::round(corner.y() / grid),
                                           std::round(corner.z() / grid)};
      const auto [entry, is_new] = number_at.try_emplace(place, static_cast<int>(result.corners.size()));
      if (is_new) result.corners.push_back(corner);
      renumbered[k] = entry->second;
    }
    const bool has_edges =
        renumbered[0] != renumbered[1] && renumbered[1] != renumbered[2] && renumbered[2] != renumbered[0];
    if (has_edges && seen.insert(canonical(renumbered)).second) result.triangles.push_back(renumbered);
  }
  return result;
}

using Edge = std::pair<int, int>;  // corners, the smaller number first

// The triangles at each edge; two of them on a closed surface.
std::map<Edge, std::vector<std::size_t>> neighbours(const Mesh& mesh) {
  std::map<Edge, std::vector<std::size_t>> beside;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      beside[std::minmax({mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]})].push_back(t);
  return beside;
}

void require_closed(const Mesh& mesh, const std::map<Edge, std::vector<std::size_t>>& beside) {
  int open = 0;
  int crowded = 0;
  std::string place;
  for (const auto& [edge, triangles] : beside) {
    open += triangles.size() == 1 ? 1 : 0;
    crowded += triangles.size() > 2 ? 1 : 0;
    if (triangles.size() != 2 && place.empty()) {
      const Vec3 middle = (mesh.corners[edge.first] + mesh.corners[edge.second]) / 2;
      place = fmt::format("must be 0: every edge must have two triangles; the first that has not lies at ({}, {}, {})",
                          middle.x(), middle.y(), middle.z());
    }
  }
  require(crowded == 0, "mesh edges with more than two triangles", crowded, place);
  require(open == 0, "mesh edges with a single triangle", open, place);
}

bool runs_along(const Triangle& triangle, int from, int to) {
  for (std::size_t k = 0; k < 3; ++k)
    if (triangle[k] == from && triangle[(k + 1) % 3] == to) return true;
  return false;
}

// Turns the connected part that triangle `start` belongs to, neighbour by neighbour, all one way round; then outwards.
void orient_part(Mesh& mesh, const std::map<Edge, std::vector<std::size_t>>& beside, std::size_t start,
                 std::vector<bool>& done) {
  std::vector<std::size_t> part = {start};
  done[start] = true;
  for (std::size_t next = 0; next < part.size(); ++next) {
    const Triangle triangle = mesh.triangles[part[next]];
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = triangle[k];
      const int to = triangle[(k + 1) % 3];
      const auto& pair = beside.at(std::minmax({from, to}));
      const std::size_t other = pair[0] == part[next] ? pair[1] : pair[0];
      const bool same_way = runs_along(mesh.triangles[other], from, to);
      require(!(same_way && done[other]), "mesh surface", "one-sided", "must have an inside and an outside");
      if (!done[other]) {
        if (same_way) std::swap(mesh.triangles[other][1], mesh.triangles[other][2]);
        done[other] = true;
        part.push_back(other);
      }
    }
  }
  std::vector<Triangle> surface;
  surface.reserve(part.size());
  for (const std::size_t t : part) surface.push_back(mesh.triangles[t]);
  if (moments_within<3>(mesh.corners, surface).volume < 0.0)
    for (const std::size_t t : part) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
}

}  // namespace

Mesh repaired(const Mesh& mesh) {
  require(!mesh.triangles.empty(), "mesh triangles", 0.0, "must be 4 or more");
  Mesh result = merged(mesh);
  const auto beside = neighbours(result);
  require_closed(result, beside);
  std::vector<bool> done(result.triangles.size(), false);
  for (std::size_t t = 0; t < done.size(); ++t)
    if (!done[t]) orient_part(result, beside, t, done);
  const double length = bounds_of(result).diagonal().norm();
  const double volume = result.triangles.empty() ? 0.0 : moments(result).volume;
  require(volume > flatness * length * length * length, "mesh volume", volume, "must be positive for its length");
  return result;
}

}  // namespace talus

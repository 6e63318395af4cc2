#include "common/mesh/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "common/math/hash.h"
#include "common/math/require.h"
#include "common/shape/polygon.h"

namespace talus {

Moments<3> moments(const Mesh& mesh) { return moments_within<3>(mesh.corners, mesh.triangles); }

std::uint64_t content_hash(const Mesh& mesh) {
  Fnv1a hash;
  for (const Vec3& corner : mesh.corners)
    for (const double coordinate : corner) hash.add(std::bit_cast<std::uint64_t>(coordinate));
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle) hash.add(static_cast<std::uint64_t>(corner));
  return hash.value();
}

Box<3> bounds_of(const Mesh& mesh) {
  Box<3> bounds;
  for (const Vec3& corner : mesh.corners) {
    require(corner.allFinite(), "mesh corner", fmt::format("({}, {}, {})", corner.x(), corner.y(), corner.z()),
            "must be finite");
    bounds.extend(corner);
  }
  return bounds;
}

namespace {

using Triangle = std::array<int, 3>;

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

/// A side of a triangle, from its corner `side` to the next one.
struct Side {
  std::size_t triangle = 0;
  std::size_t side = 0;
};

int from_of(const Mesh& mesh, const Side& at) { return mesh.triangles[at.triangle][at.side]; }
int to_of(const Mesh& mesh, const Side& at) { return mesh.triangles[at.triangle][(at.side + 1) % 3]; }

/// The sides at each edge: two of them on a closed surface, more where closed surfaces touch.
std::map<Edge, std::vector<Side>> sides_at_edges(const Mesh& mesh) {
  std::map<Edge, std::vector<Side>> sides;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      sides[std::minmax({from_of(mesh, {t, k}), to_of(mesh, {t, k})})].push_back({t, k});
  return sides;
}

/// A side of an edge that closed surfaces share.
struct TouchingSide {
  Side side;
  bool along = false;  // the edge, from its first corner to its second
  double angle = 0.0;  // of its triangle about the edge, from that of the first one [rad]
};

std::vector<TouchingSide> around(const Mesh& mesh, const Edge& edge, const std::vector<Side>& sides) {
  constexpr double same = 1e-6;  // [rad] between triangles in one plane
  const Vec3& origin = mesh.corners[edge.first];
  const Vec3 axis = (mesh.corners[edge.second] - origin).normalized();
  const auto across = [&](const Side& side) {
    const Vec3 to_third = mesh.corners[mesh.triangles[side.triangle][(side.side + 2) % 3]] - origin;
    return along_plane<Vec3>(to_third, axis).normalized();
  };
  const Vec3 zero = across(sides.front());
  std::vector<TouchingSide> all;
  for (const Side& side : sides) {
    const Vec3 here = across(side);
    double angle = std::atan2(zero.cross(here).dot(axis), zero.dot(here));
    if (angle < -same) angle += 2.0 * std::numbers::pi;
    all.push_back({side, from_of(mesh, side) == edge.first, same * std::round(angle / same)});
  }
  // Downwards in angle the solid lies behind a side that runs along the edge, up to one that runs against it. Of two in
  // one plane the latter comes first: what they enclose is not between them.
  std::ranges::sort(all, [](const TouchingSide& a, const TouchingSide& b) {
    return a.angle != b.angle ? a.angle > b.angle : a.along < b.along;
  });
  return all;
}

/// The side on the other side of each edge, as 3 * triangle + side: across an edge that closed surfaces share, that of
/// the same surface.
class Neighbours {
 public:
  explicit Neighbours(const Mesh& mesh) : other_(3 * mesh.triangles.size()) {
    for (const auto& [edge, sides] : sides_at_edges(mesh))
      if (sides.size() == 2)
        join(sides[0], sides[1]);
      else if (sides.size() == 1)
        note(mesh, edge, open_);
      else if (!join_touching(around(mesh, edge, sides)))
        note(mesh, edge, crowded_);
    require(crowded_.count == 0, "mesh edges with more than two triangles", crowded_.count,
            fmt::format("must be edges where closed pieces touch, each with its triangles counter-clockwise seen from "
                        "outside; the first that is none lies at {}",
                        crowded_.place));
    require(open_.count == 0, "mesh edges with a single triangle", open_.count,
            fmt::format("must be 0, so that the surface is closed; the first lies at {}", open_.place));
  }

  Side across(const Side& from) const { return other_[3 * from.triangle + from.side]; }

 private:
  void join(const Side& a, const Side& b) {
    other_[3 * a.triangle + a.side] = b;
    other_[3 * b.triangle + b.side] = a;
  }

  bool join_touching(const std::vector<TouchingSide>& all) {
    const auto next = [&](std::size_t i) -> const TouchingSide& { return all[(i + 1) % all.size()]; };
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].along == next(i).along) return false;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].along) join(all[i].side, next(i).side);
    return true;
  }

  /// Edges that are in the way.
  struct Fault {
    int count = 0;
    std::string place;  // of the first one
  };

  static void note(const Mesh& mesh, const Edge& edge, Fault& fault) {
    if (++fault.count > 1) return;
    const Vec3 middle = (mesh.corners[edge.first] + mesh.corners[edge.second]) / 2;
    fault.place = fmt::format("({}, {}, {})", middle.x(), middle.y(), middle.z());
  }

  std::vector<Side> other_;
  Fault open_;
  Fault crowded_;
};

/// Turns the connected part that triangle `start` belongs to, neighbour by neighbour, all one way round; then outwards.
void orient_part(Mesh& mesh, const Mesh& as_read, const Neighbours& neighbours, std::size_t start,
                 std::vector<bool>& done, std::vector<bool>& turned) {
  std::vector<std::size_t> part = {start};
  done[start] = true;
  for (std::size_t next = 0; next < part.size(); ++next) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Side here = {part[next], k};
      const Side there = neighbours.across(here);
      const bool same_way = from_of(as_read, here) == from_of(as_read, there);
      const bool turn = turned[here.triangle] != same_way;
      require(!done[there.triangle] || turned[there.triangle] == turn, "mesh surface", "one-sided",
              "must have an inside and an outside");
      if (done[there.triangle]) continue;
      turned[there.triangle] = turn;
      done[there.triangle] = true;
      part.push_back(there.triangle);
    }
  }
  std::vector<Triangle> surface;
  surface.reserve(part.size());
  for (const std::size_t t : part) {
    if (turned[t]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    surface.push_back(mesh.triangles[t]);
  }
  if (moments_within<3>(mesh.corners, surface).volume < 0.0)
    for (const std::size_t t : part) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
}

}  // namespace

Mesh repaired(const Mesh& mesh) {
  require(!mesh.triangles.empty(), "mesh triangles", 0.0, "must be 4 or more");
  Mesh result = merged(mesh);
  const Mesh as_read = result;
  const Neighbours neighbours(as_read);
  std::vector<bool> done(result.triangles.size(), false);
  std::vector<bool> turned(result.triangles.size(), false);
  for (std::size_t t = 0; t < done.size(); ++t)
    if (!done[t]) orient_part(result, as_read, neighbours, t, done, turned);
  const double length = bounds_of(result).diagonal().norm();
  const double volume = result.triangles.empty() ? 0.0 : moments(result).volume;
  require(volume > flatness * length * length * length, "mesh volume", volume, "must be positive for its length");
  return result;
}

}  // namespace talus

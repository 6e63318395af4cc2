#include "common/shape/polygon_partition.h"

#include <algorithm>

#include "common/math/require.h"
#include "common/shape/polygon.h"

namespace talus {
namespace {

using Indices = std::vector<std::size_t>;  // a loop of corners by their numbers

std::vector<Vec2> places(const std::vector<Vec2>& corners, const Indices& loop) {
  std::vector<Vec2> result;
  for (const std::size_t index : loop) result.push_back(corners[index]);
  return result;
}

// Whether the point lies in the triangle or on its edges.
bool holds(const std::vector<Vec2>& triangle, const Vec2& point) {
  return cross(triangle[0], triangle[1], point) >= 0.0 && cross(triangle[1], triangle[2], point) >= 0.0 &&
         cross(triangle[2], triangle[0], point) >= 0.0;
}

// Counter-clockwise, without corners in the middle of a straight edge.
std::vector<Vec2> tidied(std::span<const Vec2> corners) {
  Box<2> bounds;
  for (const Vec2& corner : corners) bounds.extend(corner);
  const double least = flatness * bounds.diagonal().norm();
  std::vector<Vec2> result(corners.begin(), corners.end());
  for (std::size_t i = 0; i < result.size() && result.size() > 3;) {
    const Vec2& before = result[(i + result.size() - 1) % result.size()];
    const Vec2& after = result[(i + 1) % result.size()];
    if (std::abs(distance_from_line(result[i], before, after)) <= least)
      result.erase(result.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
  if (signed_area(result) < 0.0) std::reverse(result.begin(), result.end());
  return result;
}

// How well-shaped a triangle is: its area over the square of its longest edge. Slivers are what solvers stumble over.
double quality(const std::vector<Vec2>& triangle) {
  const double longest = std::max({(triangle[1] - triangle[0]).squaredNorm(), (triangle[2] - triangle[1]).squaredNorm(),
                                   (triangle[0] - triangle[2]).squaredNorm()});
  return signed_area(triangle) / longest;
}

// Position in the loop of the best-shaped ear: a corner whose triangle with its neighbours holds no other corner.
std::size_t best_ear(const std::vector<Vec2>& corners, const Indices& loop) {
  std::size_t best = loop.size();
  double best_quality = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t before = (i + loop.size() - 1) % loop.size();
    const std::size_t after = (i + 1) % loop.size();
    const std::vector<Vec2> triangle = places(corners, {loop[before], loop[i], loop[after]});
    if (quality(triangle) <= best_quality || non_convex_corner(triangle)) continue;
    bool empty = true;
    for (std::size_t other = 0; other < loop.size() && empty; ++other)
      empty = other == before || other == i || other == after || !holds(triangle, corners[loop[other]]);
    if (empty) {
      best = i;
      best_quality = quality(triangle);
    }
  }
  require(best < loop.size(), "polygon corner", text(corners[loop[0]]),
          "must not lie in a part of the polygon that is thinner than a millionth of its length");
  return best;
}

std::vector<Indices> triangulation(const std::vector<Vec2>& corners) {
  Indices loop(corners.size());
  for (std::size_t i = 0; i < loop.size(); ++i) loop[i] = i;
  std::vector<Indices> triangles;
  while (loop.size() >= 3) {
    const std::size_t ear = best_ear(corners, loop);
    triangles.push_back({loop[(ear + loop.size() - 1) % loop.size()], loop[ear], loop[(ear + 1) % loop.size()]});
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

struct Diagonal {
  std::size_t from, to;
  double length;
};

// Each cut once, the longest first: it keeps the pieces compact.
std::vector<Diagonal> diagonals(const std::vector<Vec2>& corners, const std::vector<Indices>& triangles) {
  std::vector<Diagonal> result;
  for (const Indices& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t from = triangle[i];
      const std::size_t to = triangle[(i + 1) % 3];
      const bool edge = to == (from + 1) % corners.size();
      if (!edge && from < to) result.push_back({from, to, (corners[to] - corners[from]).norm()});
    }
  }
  std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.length > b.length; });
  return result;
}

// The piece with an edge from one corner to another, turned so that it begins with `to` and ends with `from`.
std::vector<Indices>::iterator piece_with_edge(std::vector<Indices>& pieces, std::size_t from, std::size_t to) {
  for (auto piece = pieces.begin(); piece != pieces.end(); ++piece) {
    const auto at = std::find(piece->begin(), piece->end(), to);
    const std::size_t position = at - piece->begin();
    if (at != piece->end() && (*piece)[(position + piece->size() - 1) % piece->size()] == from) {
      std::rotate(piece->begin(), at, piece->end());
      return piece;
    }
  }
  return pieces.end();
}

// Hertel and Mehlhorn: takes every diagonal away without which the two pieces beside it are one convex piece.
void merge(const std::vector<Vec2>& corners, std::vector<Indices>& pieces) {
  for (const Diagonal& diagonal : diagonals(corners, pieces)) {
    const auto left = piece_with_edge(pieces, diagonal.from, diagonal.to);
    const auto right = piece_with_edge(pieces, diagonal.to, diagonal.from);
    Indices both = *left;
    both.insert(both.end(), right->begin() + 1, right->end() - 1);
    if (both.size() <= most_corners && !non_convex_corner(places(corners, both))) {
      *left = std::move(both);
      pieces.erase(right);
    }
  }
}

}  // namespace

std::vector<std::vector<Vec2>> convex_partition(std::span<const Vec2> corners) {
  check_simple_polygon(corners);
  const std::vector<Vec2> tidy = tidied(corners);
  std::vector<Indices> pieces = triangulation(tidy);
  merge(tidy, pieces);
  std::vector<std::vector<Vec2>> result;
  for (const Indices& piece : pieces) result.push_back(places(tidy, piece));
  return result;
}

}  // namespace talus

#include "common/measure/volume_within.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace talus {
namespace {

constexpr HeightRange nowhere = {.from = 0.0, .to = -1.0};
constexpr double parallel = 1e-12;  // sine of the angle between a line and a plane along it

/// Where low <= at + slope t <= high.
HeightRange slab(double at, double slope, double low, double high) {
  if (std::abs(slope) < parallel) return at >= low && at <= high ? HeightRange() : nowhere;
  const double one = (low - at) / slope;
  const double other = (high - at) / slope;
  return {std::min(one, other), std::max(one, other)};
}

/// Where a line, from `from` along `direction`, is within `radius` of the origin.
template <int Dim>
HeightRange within_radius(const Vec<Dim>& from, const Vec<Dim>& direction, double radius) {
  const double square = direction.squaredNorm();
  if (square < parallel) return from.norm() <= radius ? HeightRange() : nowhere;
  const double middle = -from.dot(direction) / square;
  const double left = radius * radius - (from + middle * direction).squaredNorm();
  if (left < 0.0) return nowhere;
  const double half = std::sqrt(left / square);
  return {middle - half, middle + half};
}

/// A piece with what all lines need of it.
template <int Dim>
struct Prepared {
  const ConvexPiece<Dim>& piece;
  Box<Dim> bounds;
  std::vector<HeightRange> limits = {};  // by normal: of the corners along it

  explicit Prepared(const ConvexPiece<Dim>& of) : piece(of), bounds(of.bounds()) {
    for (const Vec<Dim>& normal : of.normals) {
      HeightRange& range = limits.emplace_back(HeightRange{.from = normal.dot(of.corners[0]), .to = -1e300});
      for (const Vec<Dim>& corner : of.corners) {
        range.from = std::min(range.from, normal.dot(corner));
        range.to = std::max(range.to, normal.dot(corner));
      }
    }
  }
};

/// Of a ball or a capsule, which is convex: the balls at its ends and the cylinder between them.
template <int Dim>
HeightRange within_round(const ConvexPiece<Dim>& piece, const Vec<Dim>& from) {
  const Vec<Dim> up = Vec<Dim>::Unit(Dim - 1);
  std::vector<HeightRange> parts;
  for (const Vec<Dim>& corner : piece.corners) parts.push_back(within_radius<Dim>(from - corner, up, piece.radius));
  if (piece.corners.size() == 2) {
    const double length = (piece.corners[1] - piece.corners[0]).norm();
    const Vec<Dim> axis = (piece.corners[1] - piece.corners[0]) / length;
    const Vec<Dim> away = from - piece.corners[0];
    const HeightRange beside = slab(axis.dot(away), axis.dot(up), 0.0, length);
    parts.push_back(within_radius<Dim>(along_plane<Vec<Dim>>(away, axis), along_plane<Vec<Dim>>(up, axis), piece.radius)
                        .within(beside));
  }
  HeightRange all = nowhere;
  for (const HeightRange& part : parts) {
    if (part.from > part.to) continue;
    all = all.from > all.to ? part : HeightRange{std::min(all.from, part.from), std::max(all.to, part.to)};
  }
  return all;
}

/// The heights at which the vertical line through a point of height 0 is within a piece.
template <int Dim>
HeightRange heights_within(const Prepared<Dim>& prepared, const Vec<Dim>& from) {
  for (int axis = 0; axis < Dim - 1; ++axis)
    if (from[axis] < prepared.bounds.min()[axis] || from[axis] > prepared.bounds.max()[axis]) return nowhere;
  const ConvexPiece<Dim>& piece = prepared.piece;
  if (piece.radius > 0.0) return within_round(piece, from);
  HeightRange range;
  for (std::size_t i = 0; i < piece.normals.size(); ++i) {
    const Vec<Dim>& normal = piece.normals[i];
    range = range.within(slab(normal.dot(from), normal[Dim - 1], prepared.limits[i].from, prepared.limits[i].to));
  }
  return range;
}

/// Total length of ranges that may overlap. Sorts them.
double joined_length(std::vector<HeightRange>& ranges) {
  std::ranges::sort(ranges, {}, &HeightRange::from);
  double length = 0.0;
  double done = -std::numeric_limits<double>::infinity();
  for (const HeightRange& range : ranges) {
    length += HeightRange{std::max(range.from, done), range.to}.length();
    done = std::max(done, range.to);
  }
  return length;
}

/// A column along one axis.
struct Column {
  double middle = 0.0;
  double width = 0.0;
};

/// `lines` columns or a few more between two ends, none of which goes over a bound of a piece.
template <int Dim>
std::vector<Column> columns_along(int axis, double from, double to, std::span<const Prepared<Dim>> pieces, int lines) {
  std::vector<double> ends = {from, to};
  for (const Prepared<Dim>& piece : pieces)
    for (const double end : {piece.bounds.min()[axis], piece.bounds.max()[axis]})
      if (end > from && end < to) ends.push_back(end);
  std::ranges::sort(ends);
  std::vector<Column> columns;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double gap = ends[i + 1] - ends[i];
    if (gap <= 0.0) continue;
    const int count = std::max(1, static_cast<int>(std::ceil(lines * gap / (to - from))));
    for (int k = 0; k < count; ++k) columns.push_back({ends[i] + (k + 0.5) * gap / count, gap / count});
  }
  return columns;
}

}  // namespace

template <int Dim>
bool RegionForm<Dim>::holds(const Vec<Dim>& point) const {
  if (params_.centre) return (point - *params_.centre).norm() <= params_.radius;
  return bounds().contains(point);
}

template <int Dim>
bool RegionForm<Dim>::holds(const Box<Dim>& box) const {
  if (!params_.centre) return bounds().contains(box);
  const Vec<Dim> farthest = (box.min() - *params_.centre).cwiseAbs().cwiseMax((box.max() - *params_.centre).cwiseAbs());
  return farthest.norm() <= params_.radius;
}

template <int Dim>
bool RegionForm<Dim>::holds(const Vec<Dim>& point, double distance) const {
  if (params_.centre) return (point - *params_.centre).norm() + distance <= params_.radius;
  const Vec<Dim> around = Vec<Dim>::Constant(distance);
  return bounds().contains(Box<Dim>(point - around, point + around));
}

template <int Dim>
Box<Dim> RegionForm<Dim>::bounds() const {
  if (params_.centre) {
    const Vec<Dim> half = Vec<Dim>::Constant(params_.radius);
    return {*params_.centre - half, *params_.centre + half};
  }
  if (!params_.box.empty()) return {params_.box[0], params_.box[1]};
  Vec<Dim> end = Vec<Dim>::Constant(std::numeric_limits<double>::infinity());
  Box<Dim> layer(-end, end);
  layer.min()[Dim - 1] = params_.layer[0];
  layer.max()[Dim - 1] = params_.layer[1];
  return layer;
}

template <int Dim>
HeightRange RegionForm<Dim>::heights_at(const Vec<Dim>& point) const {
  if (params_.centre) {
    Vec<Dim> from = point - *params_.centre;
    const double there = height<Dim>(*params_.centre);
    from[Dim - 1] = 0.0;
    const HeightRange range = within_radius<Dim>(from, Vec<Dim>::Unit(Dim - 1), params_.radius);
    return {there + range.from, there + range.to};
  }
  const Box<Dim> box = bounds();
  for (int axis = 0; axis < Dim - 1; ++axis)
    if (point[axis] < box.min()[axis] || point[axis] > box.max()[axis]) return nowhere;
  return {height<Dim>(box.min()), height<Dim>(box.max())};
}

template <int Dim>
double RegionForm<Dim>::volume() const {
  if (!params_.centre) return bounds().sizes().prod();
  constexpr double unit = Dim == 2 ? std::numbers::pi : 4.0 / 3.0 * std::numbers::pi;
  return unit * std::pow(params_.radius, Dim);
}

template <int Dim>
double volume_within(const RegionForm<Dim>& region, std::span<const ConvexPiece<Dim>> pieces, int lines,
                     double ground) {
  std::vector<Prepared<Dim>> prepared;
  Box<Dim> box;
  for (const ConvexPiece<Dim>& piece : pieces) {
    prepared.emplace_back(piece);
    box.extend(prepared.back().bounds);
  }
  const Box<Dim> all = region.bounds();
  if (height<Dim>(all.min()) < ground) box = all;
  box = box.intersection(all);
  if (box.isEmpty()) return 0.0;
  std::array<std::vector<Column>, 2> columns = {{{{0.0, 1.0}}, {{0.0, 1.0}}}};
  for (int axis = 0; axis < Dim - 1; ++axis)
    columns[axis] = columns_along<Dim>(axis, box.min()[axis], box.max()[axis], prepared, lines);
  double volume = 0.0;
  std::vector<HeightRange> ranges;
  for (const Column& x : columns[0]) {
    for (const Column& y : columns[1]) {
      Vec<Dim> at = Vec<Dim>::Zero();
      at[0] = x.middle;
      if constexpr (Dim == 3) at[1] = y.middle;
      const HeightRange inside = region.heights_at(at);
      ranges = {HeightRange{.to = ground}.within(inside)};
      for (const Prepared<Dim>& piece : prepared) ranges.push_back(heights_within<Dim>(piece, at).within(inside));
      volume += x.width * y.width * joined_length(ranges);
    }
  }
  return volume;
}

template class RegionForm<2>;
template class RegionForm<3>;
template double volume_within(const RegionForm<2>&, std::span<const ConvexPiece<2>>, int, double);
template double volume_within(const RegionForm<3>&, std::span<const ConvexPiece<3>>, int, double);

}  // namespace talus

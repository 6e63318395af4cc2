#pragma once
// How much of convex pieces lies in a region.

#include <algorithm>
#include <limits>
#include <span>

#include "common/scene/instruments.h"
#include "common/shape/convex_piece.h"

namespace talus {

/// A range of heights [m]; empty where the lower is above the upper.
struct HeightRange {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();

  double length() const { return from < to ? to - from : 0.0; }
  HeightRange within(const HeightRange& other) const { return {std::max(from, other.from), std::min(to, other.to)}; }
};

/// The place of a RegionParams.
template <int Dim>
class RegionForm {
 public:
  explicit RegionForm(const RegionParams<Dim>& params) : params_(params) {}

  bool holds(const Vec<Dim>& point) const;
  /// Whether all of a box is within.
  bool holds(const Box<Dim>& box) const;
  /// Whether the whole ball of radius `distance` [m] around a point is within.
  bool holds(const Vec<Dim>& point, double distance) const;
  /// The smallest box around the region; that of a layer has no end to the sides.
  Box<Dim> bounds() const;
  /// On the vertical line through a point.
  HeightRange heights_at(const Vec<Dim>& point) const;
  /// [m^3], in 2D [m^2]; infinite of a layer.
  double volume() const;

 private:
  RegionParams<Dim> params_;
};

/// Volume of the pieces, and of all below `ground`, within the region, what lies in several of them once [m^3] (2D:
/// area [m^2]). Sums vertical lines through `lines` columns along each horizontal axis, or a few more: exact along the
/// lines and of pieces whose sides are parallel to the axes, else to some 1 / lines^2 of the pieces' bounds.
template <int Dim>
double volume_within(const RegionForm<Dim>& region, std::span<const ConvexPiece<Dim>> pieces, int lines,
                     double ground = -std::numeric_limits<double>::infinity());

}  // namespace talus

#pragma once
// A pile's shape in a handful of numbers.

#include <span>
#include <vector>

#include "common/measure/surface.h"

namespace talus {

/// All about one pile at one moment.
template <int Dim>
struct ShapeStatistics {
  int bodies = 0;
  Vec<Dim> centre = Vec<Dim>::Zero();  // of mass [m]
  double centre_height = 0.0;          // of the centre of mass above the ground [m]
  double r50 = 0.0;                    // radius around the grid's centre that holds half of the bodies' centres [m]
  double r95 = 0.0;                    // 95 % of them; the rest may have rolled away [m]
  double peak = 0.0;                   // highest point of a body above the ground [m]
  std::vector<ProfileBin> profile;
  AngleOfRepose repose;
};

/// All zero for no bodies. Whether the angle is one of repose is for pile_form() to say.
template <int Dim>
ShapeStatistics<Dim> shape_statistics(std::span<const PlacedBody<Dim>> bodies, const ProfileGrid<Dim>& grid);

/// Bins of D / 2 around the bodies' middle, as many as reach the farthest of them but no more than 2,000 (2D) or 250
/// (3D). `base` [m] is the ground's height, `extent` [m] > 0 is D. Of two runs to compare, one's grid serves both.
template <int Dim>
ProfileGrid<Dim> grid_around(std::span<const PlacedBody<Dim>> bodies, double base, double extent);

/// Horizontal mean of the bodies' centres [m]: the grid's centre where a pile's own is not known.
template <int Dim>
Vec<Dim - 1> middle(std::span<const PlacedBody<Dim>> bodies);

}  // namespace talus

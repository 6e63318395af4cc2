#pragma once
// Which numbers of a pile's shape mean something: a heap has a slope, a bed between walls a packing, a bin no angle of
// repose.

#include <optional>
#include <string>

#include "common/measure/shape_statistics.h"
#include "common/world/world_description.h"

namespace talus {

/// A number, or one line that says why there is none.
template <typename Value>
struct Applicable {
  std::optional<Value> value = {};
  std::string why_not = {};
};

struct PileForm {
  Applicable<AngleOfRepose> slope;
  Applicable<double> packing;  // solid volume over the volume of the pile
};

/// Slope and packing where they apply. Both take 16 bodies and vertical gravity.
///
/// A heap stands free: obstacles hold no more than a twentieth of its bodies. From quarter to quarter of r95 its
/// surface falls outwards, by 5 degrees or more, from a height of 2 D. Its packing is that of the outline that the
/// slope draws.
///
/// Where obstacles hold more bodies there is no slope. The packing is then that of a bed: solid volume over the area
/// that the bodies cover, seen from above, times twice the height of the centre of mass above their lowest point, exact
/// for a bed with upright walls and a level surface. It is above 1 where bodies overlap. Whether the bed is one shows
/// in how the volume is spread over its height: the standard deviation over the mean is 1 / sqrt(3) for a bed, 1 /
/// sqrt(2) for a wedge.
///
/// `shape` is that of `bodies` on `grid`; `world` is as it is at that moment (world_at()); `extent` [m] > 0 is D.
template <int Dim>
PileForm pile_form(std::span<const PlacedBody<Dim>> bodies, const ShapeStatistics<Dim>& shape,
                   const ProfileGrid<Dim>& grid, const WorldDescription<Dim>& world, double extent);

}  // namespace talus

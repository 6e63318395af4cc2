#pragma once
// Janssen's law of a column between walls: load = saturation (1 - exp(-depth / decay_length)).

#include <optional>
#include <span>

#include "common/measure/instrument_meters.h"

namespace talus {

/// Part of a column between two heights.
struct ColumnSlice {
  double depth = 0.0;      // of its middle: the height of a column of the weight above it [m]
  double thickness = 0.0;  // [m]
  double load = 0.0;       // vertical force through its middle [N]
  double carried = 0.0;    // by the walls beside it [N]
};

struct JanssenLaw {
  double saturation = 0.0;    // [N]
  double decay_length = 0.0;  // [m]
};

/// Least squares over the loads. Both numbers are NaN with fewer than three slices.
JanssenLaw fitted_law(std::span<const ColumnSlice> slices);

/// By Janssen's formula: the walls carry the share 1 / decay_length of the load per metre, and at saturation all that
/// is added, `weight_per_metre` [N/m]. With A the area of the column, P its perimeter, K the ratio of pressures and f
/// the friction of the walls, the decay length is A / (P K f).
JanssenLaw law_by_formula(std::span<const ColumnSlice> slices, double weight_per_metre);

struct ColumnNumbers {
  double saturation = 0.0;      // by fitted_law() over that by law_by_formula()
  double decay_length = 0.0;    // the same
  double pressure_ratio = 0.0;  // K: pressure on the wall over the vertical one
  double friction = 0.0;        // force along the wall over that against it
};

/// Of a column whose loads are its floor, all its walls with `heights`, and the wall to the right or left with the same
/// ones. Its first region is a box as wide as the column, in 3D a square. None without these.
template <int Dim>
std::optional<ColumnNumbers> column_numbers(const World<Dim>& world, const InstrumentMeters<Dim>& meters);

}  // namespace talus

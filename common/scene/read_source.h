#pragma once
// Sources in scene files.

#include <array>
#include <vector>

#include "common/scene/read_shape.h"
#include "common/scene/scene.h"
#include "common/scene/table_reader.h"

namespace talus {

/// Keys of `[source.scale]`: a distribution of sizes, as a number of sizes of equal share. scale_fields has the unit,
/// range and effect of each.
struct ScaleParams {
  std::vector<double> uniform = {};
  double lognormal = 0.0;
  std::vector<double> factors = {};
  std::vector<double> shares = {};
  int classes = 12;
};

inline constexpr Range factor_range = between(0.01, 100.0);
inline constexpr auto scale_fields = std::to_array<Field<ScaleParams>>({
    {place_of<&ScaleParams::uniform>,
     {.name = "uniform",
      .range = factor_range,
      .further_rule = "two, the smaller first",
      .default_text = "none",
      .meaning = "factors of the size, uniformly distributed between these two. One of `uniform`, `lognormal` and "
                 "`factors` is given"}},
    {place_of<&ScaleParams::lognormal>,
     {.name = "lognormal",
      .range = above(0.0, 1.0),
      .default_text = "none",
      .meaning = "standard deviation of the logarithm of the factor, whose median is 1"}},
    {place_of<&ScaleParams::factors>,
     {.name = "factors", .range = factor_range, .default_text = "none", .meaning = "these factors only"}},
    {place_of<&ScaleParams::shares>,
     {.name = "shares",
      .range = above(0.0, 1e6),
      .further_rule = "as many as `factors`",
      .default_text = "equal",
      .meaning = "of the bodies of each of the `factors`; only ratios matter"}},
    {place_of<&ScaleParams::classes>,
     {.name = "classes",
      .range = between(2.0, 100.0),
      .meaning = "sizes that stand for the distribution, at the middle of shares of equal probability: with 12 the "
                 "middle of the last is 1.73 standard deviations of a lognormal distribution out"}},
});

/// One `[[source]]`. Shapes of other sizes are appended to the world's. Where shapes were wrong, rules that depend on
/// them are not checked.
template <int Dim>
Source<Dim> read_source(TableReader& table, ShapeNames& shapes, WorldDescription<Dim>& world);

}  // namespace talus

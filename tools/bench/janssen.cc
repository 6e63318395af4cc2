#include "tools/bench/janssen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace talus {
namespace {

/// Best for a decay length, with the sum of its squared residuals.
struct Trial {
  JanssenLaw law;
  double residuals = std::numeric_limits<double>::infinity();
};

Trial with_decay_length(std::span<const ColumnSlice> slices, double decay_length) {
  const auto shape = [&](const ColumnSlice& slice) { return 1.0 - std::exp(-slice.depth / decay_length); };
  double loads = 0.0;
  double squares = 0.0;
  for (const ColumnSlice& slice : slices) {
    loads += shape(slice) * slice.load;
    squares += shape(slice) * shape(slice);
  }
  Trial trial{.law = {loads / squares, decay_length}, .residuals = 0.0};
  for (const ColumnSlice& slice : slices) {
    const double off = slice.load - trial.law.saturation * shape(slice);
    trial.residuals += off * off;
  }
  return trial;
}

/// Weight of the bodies' parts below a height [N].
template <int Dim>
double weight_below(const World<Dim>& world, double at) {
  double mass = 0.0;
  for (BodyIndex body = 0; body < world.states().size(); ++body) {
    if (world.states().removed[body] != 0) continue;
    const Box<Dim> bounds = world.bounds_of(body);
    const double low = height<Dim>(bounds.min());
    mass += world.shape_of(body).mass * std::clamp((at - low) / (height<Dim>(bounds.max()) - low), 0.0, 1.0);
  }
  return mass * world.gravity_size();
}

/// [N/m^3], in 2D [N/m^2]
template <int Dim>
double weight_per_volume(const World<Dim>& world) {
  double mass = 0.0;
  double volume = 0.0;
  for (BodyIndex body = 0; body < world.states().size(); ++body) {
    if (world.states().removed[body] != 0) continue;
    mass += world.shape_of(body).mass;
    volume += world.shape_of(body).volume;
  }
  return mass * world.gravity_size() / volume;
}

/// From the floor up to the last slice that is full. `walls`: all of them.
template <int Dim>
std::vector<ColumnSlice> column_slices(const World<Dim>& world, const LoadMeter<Dim>& floor,
                                       const LoadMeter<Dim>& walls, const std::vector<double>& heights,
                                       double weight_per_metre) {
  const double weight = weight_below(world, std::numeric_limits<double>::infinity());
  double carried_below = -floor.frame().mean[Dim - 1];  // by the floor and the walls up to the slice
  std::vector<ColumnSlice> slices;
  for (std::size_t i = 0; i + 1 < heights.size() && weight_below(world, heights[i + 1]) < weight; ++i) {
    const double below = weight_below(world, 0.5 * (heights[i] + heights[i + 1]));
    const double carried = -walls.profile()[i][Dim - 1];
    slices.push_back({.depth = (weight - below) / weight_per_metre,
                      .thickness = heights[i + 1] - heights[i],
                      .load = carried_below + 0.5 * carried - below,
                      .carried = carried});
    carried_below += carried;
  }
  return slices;
}

}  // namespace

JanssenLaw fitted_law(std::span<const ColumnSlice> slices) {
  constexpr int trials = 2000;
  constexpr double shortest = 0.1;  // decay length [thickness of a slice]
  constexpr double longest = 1e4;
  if (slices.size() < 3) return {std::nan(""), std::nan("")};
  Trial best;
  for (int i = 0; i <= trials; ++i) {
    const double ratio = shortest * std::pow(longest / shortest, static_cast<double>(i) / trials);
    const Trial trial = with_decay_length(slices, ratio * slices.front().thickness);
    if (trial.residuals < best.residuals) best = trial;
  }
  return best.law;
}

JanssenLaw law_by_formula(std::span<const ColumnSlice> slices, double weight_per_metre) {
  double load = 0.0;
  double carried = 0.0;
  for (const ColumnSlice& slice : slices) {
    load += slice.load * slice.thickness;
    carried += slice.carried;
  }
  const double decay_length = load / carried;
  return {weight_per_metre * decay_length, decay_length};
}

template <int Dim>
std::optional<ColumnNumbers> column_numbers(const World<Dim>& world, const InstrumentMeters<Dim>& meters) {
  const Instruments<Dim>& instruments = meters.instruments();
  if (instruments.loads.size() < 3 || instruments.regions.empty()) return std::nullopt;
  const std::vector<Vec<Dim>>& box = instruments.regions[0].box;
  const std::vector<double>& heights = instruments.loads[1].heights;
  if (heights.empty() || instruments.loads[2].heights != heights || box.empty() || !meters.regions()[0].packing)
    return std::nullopt;
  const double width = box[1][0] - box[0][0];
  const double area = std::pow(width, Dim - 1);
  const double weight_per_metre = *meters.regions()[0].packing * area * weight_per_volume(world);
  const std::vector<ColumnSlice> slices =
      column_slices(world, meters.loads()[0], meters.loads()[1], heights, weight_per_metre);
  double normal = 0.0;  // of one wall
  double shear = 0.0;
  double load = 0.0;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    normal += std::abs(meters.loads()[2].profile()[i][0]);
    shear -= meters.loads()[2].profile()[i][Dim - 1];
    load += slices[i].load * slices[i].thickness;
  }
  const JanssenLaw fit = fitted_law(slices);
  const JanssenLaw formula = law_by_formula(slices, weight_per_metre);
  return ColumnNumbers{.saturation = fit.saturation / formula.saturation,
                       .decay_length = fit.decay_length / formula.decay_length,
                       .pressure_ratio = normal / std::pow(width, Dim - 2) * area / load,
                       .friction = shear / normal};
}

template std::optional<ColumnNumbers> column_numbers(const World<2>&, const InstrumentMeters<2>&);
template std::optional<ColumnNumbers> column_numbers(const World<3>&, const InstrumentMeters<3>&);

}  // namespace talus

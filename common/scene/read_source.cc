#include "common/scene/read_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "common/scene/bounding_radius.h"
#include "common/scene/read_fields.h"
#include "common/scene/spout_rate.h"

namespace talus {
namespace {

template <int Dim>
void read_shapes(TableReader& table, std::span<const std::string> shape_names, Source<Dim>& source) {
  source.shapes.resize(shape_names.size());
  std::iota(source.shapes.begin(), source.shapes.end(), 0);
  std::vector<std::string> names;
  if (shape_names.empty()) {
    table.has("shape");  // without any shape every name would be wrong
    return;
  }
  table.read("shape", names, shape_names);
  if (!names.empty()) {
    source.shapes.clear();
  }
  for (const std::string& name : names) {
    const auto found = std::find(shape_names.begin(), shape_names.end(), name);
    source.shapes.push_back(static_cast<int>(found - shape_names.begin()));
  }
}

template <int Dim>
void read_orientation(TableReader& table, Source<Dim>& source) {
  const std::vector<std::string> choices = {"random"};
  std::string choice;
  table.read("orientation", choice, choices);
  source.orientation = read_rotation<Dim>(table);
  if (!choice.empty() && source.orientation) {
    table.reject("orientation", "must not be given beside angle_deg");
  }
}

// A body at the limit of what the source may drop; noted at `key` if the engines cannot hold it.
template <int Dim>
void check_body(TableReader& table, std::string_view key, const BodyDef<Dim>& body,
                const WorldDescription<Dim>& world) {
  try {
    check(body, world);
  } catch (const std::invalid_argument& refusal) {
    table.reject_as(refusal, key);
  }
}

template <int Dim>
void check_bodies(TableReader& table, const Source<Dim>& source, const WorldDescription<Dim>& world) {
  BodyDef<Dim> farthest;
  farthest.pose.position = source.position.cwiseAbs() + source.spread + source.sweep.cwiseAbs() + source.grid_extent();
  check_body(table, "position", farthest, world);
  BodyDef<Dim> fastest;
  fastest.velocity = source.velocity.cwiseAbs() + source.velocity_spread;
  check_body(table, "velocity", fastest, world);
  BodyDef<Dim> spinning;
  spinning.spin.setConstant(source.spin_spread);
  check_body(table, "spin_spread", spinning, world);
}

// Nothing may be born in the ground, which would throw it out again.
template <int Dim>
void check_height(TableReader& table, const Source<Dim>& source, const WorldDescription<Dim>& world) {
  if (!world.ground.present) {
    return;
  }
  const double radius = largest_radius(source, world);
  const double least = world.ground.height + radius + height<Dim>(source.spread) + std::abs(height<Dim>(source.sweep));
  if (height<Dim>(source.position) < least) {
    table.reject("position",
                 fmt::format("must be at least {:.4g} m high, so that no body reaches into the ground", least));
  }
}

// Bodies of one grid may not overlap, however they are turned: the later one would wait for ever.
template <int Dim>
void check_spacing(TableReader& table, const Source<Dim>& source, const WorldDescription<Dim>& world) {
  for (int axis = 0; axis < Dim; ++axis) {
    const double least = 2.0 * (largest_radius(source, world) + source.spread[axis]);
    if (source.grid[axis] > 1 && source.spacing[axis] < least) {
      table.reject("spacing", fmt::format("must be at least {:.4g} m, so that no two bodies of a grid touch", least));
      return;
    }
  }
}

template <int Dim>
void read_grid(TableReader& table, Source<Dim>& source) {
  Vec<Dim> grid = Vec<Dim>::Ones();
  table.read("grid", grid, between(1.0, 1000.0));
  table.read("spacing", source.spacing, spread());
  if (grid != grid.array().round().matrix()) {
    table.reject("grid", "must be whole numbers");
    return;
  }
  source.grid = grid.template cast<int>();
}

template <int Dim>
void read_motion(TableReader& table, Source<Dim>& source) {
  table.read("position", source.position, coordinate());
  table.read("spread", source.spread, spread());
  table.read("velocity", source.velocity, speed());
  table.read("velocity_spread", source.velocity_spread, between(0.0, 1e3));
  table.read("spin_spread", source.spin_spread, between(0.0, 1e4));
  table.read("sweep", source.sweep, coordinate());
  table.read("sweep_period", source.sweep_period, between(0.0, 1e6));
  constexpr double shortest_period = 0.01;  // [s]
  if (table.sound() && source.sweep_period != 0.0 && source.sweep_period < shortest_period) {
    table.reject("sweep_period", fmt::format("must be 0 or at least {}", shortest_period));
  }
  table.read("ride_above", source.ride_above, between(0.0, 1e4));
  if (source.sweep.norm() > 0.0 && source.sweep_period == 0.0) {
    table.reject("sweep", "must be given together with a sweep_period above 0");
  }
}

}  // namespace

template <int Dim>
Source<Dim> read_source(TableReader& table, std::span<const std::string> shape_names,
                        const WorldDescription<Dim>& world) {
  Source<Dim> source;
  read_shapes(table, shape_names, source);
  table.read("count", source.count, between(1, most_bodies));
  table.read("start", source.start, between(0.0, 1e6));
  table.read("rate", source.rate, {.low = 0.0, .high = 1e6, .low_excluded = true});
  read_grid(table, source);
  read_motion(table, source);
  read_orientation(table, source);
  if (table.sound() && !source.shapes.empty() && world.shapes.size() == shape_names.size()) {
    check_bodies(table, source, world);
    check_height(table, source, world);
    check_spacing(table, source, world);
  }
  return source;
}

template Source<2> read_source(TableReader&, std::span<const std::string>, const WorldDescription<2>&);
template Source<3> read_source(TableReader&, std::span<const std::string>, const WorldDescription<3>&);

}  // namespace talus

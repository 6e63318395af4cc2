#include "common/scene/read_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "common/scene/read_shape.h"
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
  std::vector<std::string> all;
  for (const std::string& name : shape_names) all.push_back(toml_text(name));
  table.fill("shape", toml_array(all));
  table.read("shape", names, shape_names);
  if (!names.empty()) source.shapes.clear();
  for (const std::string& name : names) {
    const auto found = std::find(shape_names.begin(), shape_names.end(), name);
    source.shapes.push_back(static_cast<int>(found - shape_names.begin()));
  }
}

template <int Dim>
void read_orientation(TableReader& table, Source<Dim>& source) {
  std::string choice;
  if (table.has("orientation")) table.read(orientation_key, choice);
  source.orientation = read_rotation<Dim>(table);
  if (!choice.empty() && source.orientation)
    table.error("orientation", "must not be given beside angle_deg");
  else if (choice.empty() && !source.orientation)
    table.fill("orientation", toml_text(random_orientation));
}

/// A body at the limit of what the source may drop: an error at `key` if the engines cannot simulate it.
template <int Dim>
void check_body(TableReader& table, std::string_view key, const BodyDef<Dim>& body,
                const WorldDescription<Dim>& world) {
  table.check([&] { check(body, world); }, key);
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

/// No body may appear in the ground, which would push it out.
template <int Dim>
void check_height(TableReader& table, const Source<Dim>& source, const WorldDescription<Dim>& world) {
  if (!world.ground.present) return;
  const double reach = -height<Dim>(largest_bounds(source, world).min());
  const double least = world.ground.height + reach + height<Dim>(source.spread) + std::abs(height<Dim>(source.sweep));
  if (height<Dim>(source.position) < least) {
    table.error("position",
                fmt::format("must be at least {:.4g} m high, so that no body reaches into the ground", least));
  }
}

/// Bodies of one grid may not overlap at any rotation that they may have: the later one would wait without end.
template <int Dim>
void check_spacing(TableReader& table, const Source<Dim>& source, const WorldDescription<Dim>& world) {
  constexpr double rounding = 1e-9;  // [m]
  const Vec<Dim> sizes = largest_bounds(source, world).sizes();
  for (int axis = 0; axis < Dim; ++axis) {
    const double least = sizes[axis] + 2.0 * source.spread[axis];
    if (source.grid[axis] > 1 && source.spacing[axis] < least - rounding) {
      table.error("spacing", fmt::format("must be at least {:.4g} m, so that no two bodies of a grid touch", least));
      return;
    }
  }
}

template <int Dim>
void check_sweep(TableReader& table, const Source<Dim>& source) {
  constexpr double shortest_period = 0.01;  // [s]
  if (table.ok() && source.sweep_period != 0.0 && source.sweep_period < shortest_period)
    table.error("sweep_period", fmt::format("must be 0 or at least {}", shortest_period));
  if (source.sweep.norm() > 0.0 && source.sweep_period == 0.0)
    table.error("sweep", "must be given together with a sweep_period above 0");
}

}  // namespace

template <int Dim>
Source<Dim> read_source(TableReader& table, std::span<const std::string> shape_names,
                        const WorldDescription<Dim>& world) {
  Source<Dim> source;
  read_shapes(table, shape_names, source);
  table.read_fields(source, source_fields<Dim>);
  check_sweep(table, source);
  read_orientation(table, source);
  if (table.ok() && !source.shapes.empty() && world.shapes.size() == shape_names.size()) {
    if (!table.has("spread")) {
      source.spread = default_spread(source, world);
      table.fill("spread", field_text({.name = "spread"}, source.spread));
    }
    check_bodies(table, source, world);
    check_height(table, source, world);
    check_spacing(table, source, world);
  }
  return source;
}

template Source<2> read_source(TableReader&, std::span<const std::string>, const WorldDescription<2>&);
template Source<3> read_source(TableReader&, std::span<const std::string>, const WorldDescription<3>&);

}  // namespace talus

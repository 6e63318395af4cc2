#include "common/scene/read_source.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "common/scene/read_shape.h"
#include "common/scene/scene_fields.h"
#include "common/scene/spout_rate.h"

namespace talus {
namespace {

template <int Dim>
void read_shapes(TableReader& table, const ShapeNames& shapes, Source<Dim>& source) {
  source.shapes.clear();
  if (shapes.names().empty()) {
    table.has("shape");  // without any shape every name would be wrong
    return;
  }
  std::vector<std::string> all;
  for (const std::string& name : shapes.names_of_bodies()) all.push_back(toml_text(name));
  table.fill("shape", toml_array(all));
  std::vector<std::string> names;
  table.read("shape", names, shapes.names());
  if (names.empty()) names = shapes.names_of_bodies();
  for (const std::string& name : names)
    for (const int variant : shapes.variants(name)) source.shapes.push_back(variant);
}

/// The standard normal variable below which a share of the probability lies.
double normal_quantile(double share) {
  double low = -10.0;
  double high = 10.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::numbers::sqrt2) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The factor at the middle of each class; rounded, so that it is the same with every mathematical library.
std::vector<double> factors_of(const ScaleParams& params) {
  if (!params.factors.empty()) return params.factors;
  std::vector<double> factors;
  for (int i = 0; i < params.classes; ++i) {
    const double share = (i + 0.5) / params.classes;
    const double factor = params.uniform.empty() ? std::exp(params.lognormal * normal_quantile(share))
                                                 : params.uniform[0] + share * (params.uniform[1] - params.uniform[0]);
    factors.push_back(std::round(1e6 * factor) / 1e6);
  }
  return factors;
}

void check_scale(TableReader& table, const ScaleParams& params) {
  const int given = (table.has("uniform") ? 1 : 0) + (table.has("lognormal") ? 1 : 0) + (table.has("factors") ? 1 : 0);
  if (given != 1) table.error("", "must have one of uniform, lognormal and factors");
  if (table.has("uniform") && table.ok() && (params.uniform.size() != 2 || params.uniform[0] >= params.uniform[1]))
    table.error("uniform", "must be two factors, the smaller first");
  if (table.has("factors")) table.forbid("classes", "means nothing beside factors");
  if (given == 1 && !table.has("factors")) table.forbid("shares", "means nothing without factors");
  if (table.has("factors") && table.has("shares") && params.shares.size() != params.factors.size())
    table.error("shares", "must be as many as factors");
}

/// `[source.scale]`: the source's shapes in each size.
template <int Dim>
void read_scale(TableReader& table, ShapeNames& shapes, WorldDescription<Dim>& world, Source<Dim>& source) {
  ScaleParams params;
  table.read_fields(params, scale_fields);
  check_scale(table, params);
  if (!table.ok() || source.shapes.empty() || !shapes.complete()) return;
  const std::vector<double> factors = factors_of(params);
  constexpr std::size_t most_shapes = 20'000;  // of a scene
  if (world.shapes.size() + factors.size() * source.shapes.size() > most_shapes) {
    table.error("", fmt::format("must make at most {} shapes in all", most_shapes));
    return;
  }
  params.shares.resize(factors.size(), 1.0);
  const double whole = std::accumulate(params.shares.begin(), params.shares.end(), 0.0);
  std::vector<Shape<Dim>> sized;
  double sum = 0.0;
  table.check([&] {
    for (std::size_t i = 0; i < factors.size(); ++i) {
      for (const int shape : source.shapes) {
        const Shape<Dim>& original = world.shapes[shape];
        sized.push_back(scaled(original, factors[i], fmt::format("{}{}{:g}", original.name, size_mark, factors[i])));
      }
      sum += params.shares[i] / whole;
      source.shares.push_back(sum);
    }
    check_alone(sized);
  });
  if (!table.ok()) return;
  source.shapes.resize(sized.size());
  std::iota(source.shapes.begin(), source.shapes.end(), static_cast<int>(world.shapes.size()));
  shapes.add_unnamed(static_cast<int>(sized.size()));
  world.shapes.insert(world.shapes.end(), sized.begin(), sized.end());
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
  BodyDef<Dim> fastest;
  fastest.velocity = source.velocity.cwiseAbs() + source.velocity_spread;
  BodyDef<Dim> spinning;
  spinning.spin.setConstant(source.spin_spread);
  table.check_later([=, &world](TableReader& complete) {
    check_body(complete, "position", farthest, world);
    check_body(complete, "velocity", fastest, world);
    check_body(complete, "spin_spread", spinning, world);
  });
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
Source<Dim> read_source(TableReader& table, ShapeNames& shapes, WorldDescription<Dim>& world) {
  Source<Dim> source;
  read_shapes(table, shapes, source);
  table.read_fields(source, source_fields<Dim>);
  check_sweep(table, source);
  source.orientation = read_rotation<Dim>(table);
  if (table.has("scale")) table.table("scale", [&](TableReader& own) { read_scale(own, shapes, world, source); });
  if (table.ok() && !source.shapes.empty() && shapes.complete()) {
    if (!table.has("spread")) {
      source.spread = default_spread(source, world);
      table.fill("spread", field_text({.name = "spread"}, source.spread));
    }
    check_bodies(table, source, world);
    check_height(table, source, world);
    check_spacing(table, source, world);
  }
  if (source.shapes.empty()) source.shapes = {0};
  return source;
}

template Source<2> read_source(TableReader&, ShapeNames&, WorldDescription<2>&);
template Source<3> read_source(TableReader&, ShapeNames&, WorldDescription<3>&);

}  // namespace talus

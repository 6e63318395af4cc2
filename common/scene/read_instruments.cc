#include "common/scene/read_instruments.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/scene/instrument_fields.h"

namespace talus {
namespace {

/// Appends; a name that is taken is an error.
template <typename T>
void add(TableReader& table, T instrument, std::string_view kind, std::vector<T>& all) {
  if (table.ok() && std::ranges::find(all, instrument.name, &T::name) != all.end())
    table.error("name", fmt::format("must be of no other {}", kind));
  all.push_back(std::move(instrument));
}

template <int Dim>
GateParams<Dim> read_gate(TableReader& table) {
  constexpr double flattest = 1e-3;  // [m], in 3D [m^2]
  GateParams<Dim> gate;
  const bool disc = Dim == 3 && !table.has("corners");
  if (disc && !table.has("centre")) table.error("", "must have corners or centre");
  if (!disc) table.require("corners");
  for (const std::string_view key : {"centre", "normal", "radius"})
    if (Dim == 3 && !disc) table.forbid(key, "must not be given beside corners");
  table.read_fields(gate, gate_fields<Dim>);
  if (!table.ok()) return gate;
  if (!disc && gate.corners.size() != Dim)
    table.error("corners", Dim == 2 ? "must be the two ends of the line" : "must be three corners");
  else if (gate.forward().norm() < flattest)
    table.error(disc ? "normal" : "corners", Dim == 2 ? "must be at least 0.001 m apart"
                                             : disc   ? "must be at least 0.001 long"
                                                      : "must span an area of at least 0.001 m^2");
  return gate;
}

template <int Dim>
RegionParams<Dim> read_region(TableReader& table) {
  RegionParams<Dim> region;
  const int forms = (table.has("box") ? 1 : 0) + (table.has("centre") ? 1 : 0) + (table.has("layer") ? 1 : 0);
  if (forms != 1) table.error("", "must have one of box, centre and layer");
  if (!table.has("centre")) table.forbid("radius", "means nothing without centre");
  table.read_fields(region, region_fields<Dim>);
  if (!table.ok()) return region;
  const std::vector<Vec<Dim>>& box = region.box;
  if (table.has("box") && (box.size() != 2 || (box[0].array() >= box[1].array()).any()))
    table.error("box", "must be two corners, the lower one first, apart on each axis");
  if (table.has("layer") && (region.layer.size() != 2 || region.layer[0] >= region.layer[1]))
    table.error("layer", "must be two heights, the lower one first");
  return region;
}

template <int Dim>
LoadParams<Dim> read_load(TableReader& table, const Scene<Dim>& scene) {
  LoadParams<Dim> load;
  table.read_fields(load, load_fields<Dim>);
  if (table.has("heights") &&
      (load.heights.size() < 2 || !std::ranges::is_sorted(load.heights, std::ranges::less_equal())))
    table.error("heights", "must be two or more, each above the one before");
  std::vector<std::string> sides;
  for (const ObstacleName& each : scene.obstacle_names) sides.push_back(each.name);
  const bool named_ground = std::ranges::count(sides, load_on_ground) > 0;
  if (!named_ground && scene.world.ground.present) sides.emplace_back(load_on_ground);
  table.require("on");
  std::vector<std::string> all;
  if (table.has("on") && sides.empty())
    table.error("on", "must be the name of an obstacle; none here has a name, and there is no ground");
  else
    table.read("on", all, sides);
  for (const std::string& on : all) {
    const auto found = std::ranges::find(scene.obstacle_names, on, &ObstacleName::name);
    if (found == scene.obstacle_names.end())
      load.on_ground = true;
    else
      load.obstacles.push_back(static_cast<int>(found - scene.obstacle_names.begin()));
    if (table.ok() && std::ranges::count(all, on) > 1) table.error("on", "must not name anything twice");
    if (table.ok() && named_ground && on == load_on_ground && scene.world.ground.present)
      table.error("on", "must not be ground where an obstacle has that name");
  }
  return load;
}

}  // namespace

template <int Dim>
void read_instruments(TableReader& root, Scene<Dim>& scene) {
  Instruments<Dim>& all = scene.instruments;
  root.tables("gate", [&](TableReader& table) { add(table, read_gate<Dim>(table), "gate", all.gates); });
  root.tables("region", [&](TableReader& table) { add(table, read_region<Dim>(table), "region", all.regions); });
  root.tables("load", [&](TableReader& table) { add(table, read_load(table, scene), "load", all.loads); });
}

template void read_instruments(TableReader&, Scene<2>&);
template void read_instruments(TableReader&, Scene<3>&);

}  // namespace talus

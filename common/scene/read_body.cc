#include "common/scene/read_body.h"

#include <fmt/format.h>

#include <algorithm>

namespace talus {
namespace {

/// Each is compared with those near it, some microseconds a body. More bodies come from sources.
constexpr int most_placed_bodies = 100'000;

/// The shape's number; nothing, with an error, if it is not clear which shape is meant.
std::optional<int> read_shape_number(TableReader& table, const ShapeNames& shapes) {
  std::string name;
  const std::span<const std::string> names = shapes.names();
  const std::vector<std::string> usual = shapes.names_of_bodies();
  const bool given = table.has("shape");
  if (names.empty()) return std::nullopt;  // without any shape every name would be wrong
  if (!given && usual.size() != 1) {
    table.error("shape", fmt::format("must be given, since there are {} shapes", names.size()));
    return std::nullopt;
  }
  if (!usual.empty()) table.fill("shape", toml_text(usual.front()));
  table.read("shape", name, names);
  const std::vector<int> variants = shapes.variants(given ? name : usual.front());
  return variants.empty() ? std::nullopt : std::optional(variants.front());
}

/// Bodies along an axis in a layer.
template <int Dim>
int bodies_along(const BodyParams<Dim>& params, int axis, int layer) {
  if (axis == Dim - 1 || params.repeat[axis] == 1) return 1;
  return std::max(0, params.repeat[axis] - layer * params.taper);
}

template <int Dim>
int bodies_in_layer(const BodyParams<Dim>& params, int layer) {
  int bodies = 1;
  for (int axis = 0; axis < Dim - 1; ++axis) bodies *= bodies_along(params, axis, layer);
  return bodies;
}

template <int Dim>
std::int64_t bodies_in_all(const BodyParams<Dim>& params) {
  std::int64_t bodies = 0;
  for (int layer = 0; layer < params.repeat[Dim - 1]; ++layer) bodies += bodies_in_layer(params, layer);
  return bodies;
}

/// Where a body of a layer lies, seen from the first body. Layers that taper stand in the middle of the one beneath.
template <int Dim>
Vec<Dim> place_in_layer(const BodyParams<Dim>& params, int layer, int number) {
  Vec<Dim> place = layer % 2 == 1 ? params.stagger : Vec<Dim>::Zero();
  place[Dim - 1] += layer * params.step[Dim - 1];
  for (int axis = 0; axis < Dim - 1; ++axis) {
    const int along = bodies_along(params, axis, layer);
    place[axis] += (number % along + 0.5 * (params.repeat[axis] - along)) * params.step[axis];
    number /= along;
  }
  return place;
}

template <int Dim>
std::vector<BodyDef<Dim>> bodies_of(const BodyParams<Dim>& params, const Turn<Dim>& turn, int shape,
                                    const Shape<Dim>& form) {
  std::vector<BodyDef<Dim>> bodies;
  for (int layer = 0; layer < params.repeat[Dim - 1]; ++layer) {
    for (int number = 0; number < bodies_in_layer(params, layer); ++number) {
      const auto before = static_cast<double>(bodies.size());
      const Pose<Dim> pose{params.position + place_in_layer(params, layer, number),
                           turn.rotation(turn.angle + before * params.angle_step)};
      bodies.push_back({shape, pose_of_centre(form, pose), params.velocity, params.spin});
    }
  }
  return bodies;
}

/// Rules of one table that need no shape.
template <int Dim>
void check_params(TableReader& table, const BodyParams<Dim>& params) {
  const bool moves = params.velocity.norm() > 0.0 || params.spin.norm() > 0.0;
  const std::string_view given = params.velocity.norm() > 0.0 ? "velocity" : "spin";
  if (params.fixed && moves) table.error(given, "must be 0 for a fixed body");
  if (params.asleep && moves) table.error(given, "must be 0 for a body that is asleep");
  if (params.fixed && params.asleep) table.error("asleep", "must be false for a fixed body");
  if constexpr (Dim == 3) {
    if (params.angle_step != 0.0 && !table.has("axis"))
      table.error("angle_step_deg", "must be given together with angle_deg and axis");
  }
}

/// Places, by which bodies are searched for overlaps, and velocity and spin, which all bodies share: their limits
/// follow from the step.
template <int Dim>
void check_limits(TableReader& table, const std::vector<BodyDef<Dim>>& bodies, const WorldDescription<Dim>& world) {
  Box<Dim> places;
  for (const BodyDef<Dim>& body : bodies) places.extend(body.pose.position);
  BodyDef<Dim> farthest = bodies.front();
  farthest.pose.position = places.min().cwiseAbs().cwiseMax(places.max().cwiseAbs());
  farthest.velocity.setZero();
  farthest.spin.setZero();
  table.check([&] { check(farthest, world); });
  BodyDef<Dim> fastest = bodies.front();
  fastest.pose = {};
  table.check_later([=, &world](TableReader& complete) { complete.check([&] { check(fastest, world); }); });
}

/// Reports the deepest overlap of the first bodies that overlap more than is allowed: bodies that are all in one place
/// would take hours.
template <int Dim>
void check_overlap(TableReader& table, const std::vector<BodyDef<Dim>>& bodies, const BodyParams<Dim>& params,
                   const WorldDescription<Dim>& world, OverlapCheck<Dim>& placed) {
  const double allowed = std::max(params.overlap.value_or(0.0), overlap_allowed(world.units));
  constexpr int enough = 20;
  Overlap deepest;
  std::size_t first = 0;
  int found = 0;
  for (std::size_t i = 0; i < bodies.size() && found < enough; ++i) {
    const Overlap overlap = placed.add(bodies[i].shape, bodies[i].pose, params.fixed, table.path());
    if (overlap.depth <= allowed) continue;
    ++found;
    if (overlap.depth <= deepest.depth) continue;
    deepest = overlap;
    first = i;
  }
  if (deepest.depth <= 0.0) return;
  const bool of_itself = deepest.other.ends_with(" of " + table.path());
  const std::string which = bodies.size() > 1 ? fmt::format("its body {} ", first) : "it ";
  table.error(of_itself ? "step" : "position",
              fmt::format("must leave no overlap above {:.3g} m: {}is {:.3g} m deep in {}", allowed, which,
                          deepest.depth, deepest.other));
}

template <int Dim>
void append(const std::vector<BodyDef<Dim>>& bodies, const BodyParams<Dim>& params, Scene<Dim>& scene) {
  for (const BodyDef<Dim>& body : bodies)
    if (params.fixed)
      scene.world.obstacles.push_back({scene.world.shapes[body.shape], body.pose});
    else
      scene.bodies.push_back({body, params.asleep});
}

}  // namespace

template <int Dim>
void read_body(TableReader& table, const ShapeNames& shapes, OverlapCheck<Dim>& placed, Scene<Dim>& scene) {
  BodyParams<Dim> params;
  const std::optional<int> shape = read_shape_number(table, shapes);
  table.read_fields(params, body_fields<Dim>);
  const Turn<Dim> turn = read_turn<Dim>(table).value_or(Turn<Dim>());
  check_params(table, params);
  if (!table.ok() || !shape || !shapes.complete()) return;
  if (std::ssize(scene.bodies) + std::ssize(scene.world.obstacles) + bodies_in_all(params) > most_placed_bodies) {
    table.error("repeat", fmt::format("must leave at most {} bodies and obstacles at the start; sources drop more",
                                      most_placed_bodies));
    return;
  }
  const auto bodies = bodies_of(params, turn, *shape, scene.world.shapes[*shape]);
  check_limits(table, bodies, scene.world);
  if (table.ok()) check_overlap(table, bodies, params, scene.world, placed);
  if (table.ok()) append(bodies, params, scene);
}

template void read_body(TableReader&, const ShapeNames&, OverlapCheck<2>&, Scene<2>&);
template void read_body(TableReader&, const ShapeNames&, OverlapCheck<3>&, Scene<3>&);

}  // namespace talus

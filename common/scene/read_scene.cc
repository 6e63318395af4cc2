#include "common/scene/read_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <utility>

#include "common/pile/angle_of_repose.h"
#include "common/pile/pile_fields.h"
#include "common/scene/accuracy.h"
#include "common/scene/happened.h"
#include "common/scene/include.h"
#include "common/scene/policy_fields.h"
#include "common/scene/read_body.h"
#include "common/scene/read_event.h"
#include "common/scene/read_instruments.h"
#include "common/scene/read_motion.h"
#include "common/scene/read_obstacle.h"
#include "common/scene/read_shape.h"
#include "common/scene/read_source.h"
#include "common/scene/scene_fields.h"
#include "common/scene/table_reader.h"
#include "common/scene/text_limits.h"
#include "common/scene/toml_text.h"
#include "common/shape/shape_fields.h"
#include "common/world/scaled_world.h"
#include "common/world/world_fields.h"

namespace talus {
namespace {

/// What the scene names itself; the rest follows from what it holds.
struct Named {
  bool solver = false;
  bool restitution_threshold = false;
  SetByScene of_accuracy;
};

template <int Dim>
void read_world(TableReader& table, Scene<Dim>& scene, Named& named) {
  WorldDescription<Dim>& world = scene.world;
  table.forbid("dt", "must be given as its inverse, as in steps_per_second = 60");
  named.of_accuracy.steps = table.has("steps_per_second");
  constexpr std::span<const Field<WorldDescription<Dim>>> fields = world_fields<Dim>;
  if (table.is_array("gravity")) {
    Vec<Dim> gravity = world.gravity_vector();
    table.read(gravity_vector_key, gravity);
    world.set_gravity(gravity);
    table.read_fields(world, fields.subspan(1));
  } else {
    table.read_fields(world, fields);
  }
  if (named.of_accuracy.steps) table.check([&] { check_step(world, fitting_units(world)); });
  if (table.has("gravity_motion"))
    table.table("gravity_motion", [&](TableReader& own) {
      scene.gravity_motion = read_gravity_motion<Dim>(own, world.gravity_vector());
    });
  table.table("solver", [&](TableReader& solver) {
    named.solver = solver.has("kind");
    named.of_accuracy.sub_steps = solver.has("sub_steps");
    named.restitution_threshold = solver.has("restitution_threshold");
    solver.read_fields(world.solver, solver_fields);
  });
  table.check([&] { check_sides(world); });
}

void read_ground(TableReader& table, Ground& ground) {
  table.read_fields(ground, ground_fields);
  table.read_fields(ground.material, surface_fields);
}

template <int Dim>
void read_shapes(TableReader& root, ShapeNames& names, Scene<Dim>& scene) {
  std::vector<Shape<Dim>>& shapes = scene.world.shapes;
  BodyShapes<Dim> all(root, scene.seed);
  std::map<std::string, std::vector<Shape<Dim>>> read;
  const bool well_formed = root.named_tables("shape", [&](const std::string& name, TableReader& table) {
    if (name.find(size_mark) != std::string::npos || name.find(variant_mark) != std::string::npos)
      table.error("", fmt::format("NAME must have neither {} nor {}", size_mark, variant_mark));
    read[name] = all.read(name, table);
  });
  std::vector<std::string> named = root.texts_in_tables("source", "shape");
  for (std::string& name : root.texts_in_tables("body", "shape")) named.push_back(std::move(name));
  for (const std::string& name : root.names_of_tables("shape")) {
    const std::vector<Shape<Dim>>& variants = read[name];
    if (all.is_part(name) && std::ranges::count(named, name) == 0) {
      names.add_part(name);
      continue;
    }
    names.add(name, static_cast<int>(variants.size()));
    if (all.is_part(name)) names.mark_part();
    shapes.insert(shapes.end(), variants.begin(), variants.end());
  }
  if (well_formed && names.names().empty()) root.error("shape", "must be given: at least one [shape.NAME] to drop");
}

/// Sets the units of the engine, and the defaults that depend on them: step and restitution threshold.
template <int Dim>
void fit_units(WorldDescription<Dim>& world, const Named& named) {
  world.units = fitting_units(world);
  if (!named.of_accuracy.steps) world.dt = 1.0 / usual_steps_per_second(world);
  if (!named.restitution_threshold)
    world.solver.restitution_threshold = SolverParams{}.restitution_threshold / world.units.speeds();
}

template <int Dim>
void read_sources(TableReader& root, ShapeNames& shapes, Scene<Dim>& scene) {
  root.tables("source",
              [&](TableReader& table) { scene.sources.push_back(read_source<Dim>(table, shapes, scene.world)); });
  if (scene.bodies_planned() > most_bodies)
    root.error("source", fmt::format("must drop at most {} bodies together", most_bodies));
}

/// After all obstacles, which bodies must not overlap, and the events that add some of them.
template <int Dim>
void read_bodies(TableReader& root, const ShapeNames& shapes, Scene<Dim>& scene) {
  const std::vector<std::uint8_t> absent = absent_obstacles(scene, {}, 0.0);
  OverlapCheck<Dim> placed(scene.world, absent);
  root.tables("body", [&](TableReader& table) { read_body(table, shapes, placed, scene); });
  const bool has_sources = root.has("source") && !(root.ok() && scene.sources.empty());
  if (!has_sources && !root.has("body"))
    root.error("source", "must be given: at least one [[source]] or [[body]], where bodies come from");
}

template <int Dim>
void read_pile_boundary(TableReader& table, PileParams<Dim>& pile, std::vector<Obstacle<Dim>>& obstacles) {
  table.table("boundary", [&](TableReader& within) {
    pile.boundary = read_boundary<Dim>(within, pile.at.value_or(Vec<Dim>::Zero()), obstacles);
  });
  if (!pile.at) table.error("boundary", "must be given together with at, the middle of its floor");
  if (pile.control_slope)
    table.error("control_slope", "must be false within walls, which support their bodies at any slope");
  table.require("alpha_deg");  // walls hide the slope that bodies take by themselves
}

/// One `[[pile]]`; walls around it that are to be built are appended to the obstacles.
template <int Dim>
PileParams<Dim> read_pile(TableReader& table, WorldDescription<Dim>& world) {
  PileParams<Dim> pile;
  table.read_fields(pile, pile_fields<Dim>);
  if (!table.has("drift_rate")) pile.drift_rate *= world.units.times();
  if (pile.control_slope) {
    table.require("alpha_deg");
    if (pile.alpha.value_or(0.0) > max_angle_of_repose)
      table.error("alpha_deg", "must be at most 75 with control_slope: no steeper slope is measured");
  }
  if (table.has("boundary")) read_pile_boundary(table, pile, world.obstacles);
  return pile;
}

template <int Dim>
void read_policy(TableReader& table, Scene<Dim>& scene, Named& named) {
  PolicyParams& policy = scene.policy;
  table.read_fields(policy, policy_fields);
  table.read_fields(policy.paper, paper_fields);
  // The engine's own sleeping belongs to its own solver.
  scene.world.engine_sleep = policy.kind == "engine";
  if (scene.world.engine_sleep && !named.solver) scene.world.solver.kind = engine_solver;
  if (scene.world.engine_sleep && scene.world.solver.small_steps())
    table.error(
        "kind",
        R"(must not be "engine" with world.solver.kind = "small_steps": the engine's sleeping needs its own solver)");
  table.table("adaptive", [&](TableReader& own) {
    named.of_accuracy.rings = own.has("rings");
    named.of_accuracy.tolerance = own.has("tolerance");
    own.read_fields(policy.adaptive, adaptive_fields);
    if (own.ok() && policy.adaptive.rings > 0 && !scene.world.solver.small_steps())
      own.error("rings", R"(must be 0 unless world.solver.kind is "small_steps": the engines' own solvers leave out )"
                         "sleeping bodies");
  });
}

/// A source that an event adds waits for it.
template <int Dim>
void read_events(TableReader& root, const ShapeNames& shapes, Scene<Dim>& scene) {
  root.tables("event", [&](TableReader& table) { scene.events.push_back(read_event(table, shapes, scene)); });
  for (const Event<Dim>& event : scene.events)
    if (event.action == EventAction::add && !event.obstacle && event.source < std::ssize(scene.sources))
      scene.sources[event.source].waits_for_event = true;
}

/// What the engines' own solvers cannot do.
template <int Dim>
void check_solver(TableReader& root, const Scene<Dim>& scene) {
  if (scene.world.solver.small_steps()) return;
  if (std::ranges::any_of(scene.movers, [](const Mover<Dim>& mover) { return !mover.motion.belt.isZero(0.0); }))
    root.error("obstacle", R"(must have no motion of kind "belt" with the engines' own solvers)");
  if (std::ranges::count(scene.events, EventAction::force, &Event<Dim>::action) > 0)
    root.error("event", R"(must not be of do = "force" with the engines' own solvers)");
  std::set<std::string> rolling;  // without the numbers of sizes and variants
  for (const Shape<Dim>& shape : scene.world.shapes)
    if (shape.material.rolling_friction > 0.0) rolling.insert(base_name(shape.name));
  for (const std::string& name : rolling)
    root.named_table("shape", name, [](TableReader& table) {
      table.allow_unknown_keys();
      table.error("rolling_friction", R"(must be 0 where policy.kind or world.solver.kind is "engine": )"
                                      "the engines' own solvers resist no rolling");
    });
}

/// With the accuracy, which needs the frame rate and a scene without errors.
template <int Dim>
void read_run(TableReader& table, Scene<Dim>& scene, const SetByScene& set, bool complete) {
  RunParams& run = scene.run;
  table.read_fields(run, run_fields);
  if (complete && table.ok()) apply_accuracy(scene, set);
  const double dt = scene.world.dt;
  const double steps = 1.0 / (run.frame_rate * dt);
  if (table.ok() && (steps < 0.5 || std::abs(steps - std::round(steps)) > 1e-6)) {
    table.error("frame_rate", fmt::format("must divide world.steps_per_second, here {:.6g}: a frame is one or more "
                                          "whole steps",
                                          1.0 / dt));
    return;
  }
  if (table.ok() && steps * static_cast<double>(run.frames) > most_steps)
    table.error("frames", fmt::format("must make at most {} steps, here {:.3g} steps a frame", most_steps, steps));
}

/// Rules that concern the world as a whole, as masses that are too different.
template <int Dim>
void check_world(TableReader& root, const WorldDescription<Dim>& world) {
  if (!root.ok()) return;
  try {
    check(world);
  } catch (const std::invalid_argument& refusal) {
    root.error("shape", refusal.what());
  }
}

template <int Dim>
Scene<Dim> read_root(TableReader& root) {
  Scene<Dim> scene;
  root.has("include");  // read before, see include.h
  root.read_fields(scene, scene_fields<Dim>);
  std::int64_t dimension = Dim;
  root.read(dimension_key, dimension);
  Named named;
  ShapeNames shapes;
  read_shapes(root, shapes, scene);
  root.table("world", [&](TableReader& table) { read_world(table, scene, named); });
  root.table("ground", [&](TableReader& table) { read_ground(table, scene.world.ground); });
  root.tables("obstacle", [&](TableReader& table) { read_obstacle(table, scene); });
  read_sources(root, shapes, scene);
  fit_units(scene.world, named);  // by all shapes, those of sources included
  root.tables("pile", [&](TableReader& table) { scene.piles.push_back(read_pile(table, scene.world)); });
  root.table("policy", [&](TableReader& table) { read_policy(table, scene, named); });
  read_events(root, shapes, scene);
  read_bodies(root, shapes, scene);
  check_solver(root, scene);
  read_instruments(root, scene);
  root.table("run", [&](TableReader& table) { read_run(table, scene, named.of_accuracy, root.ok()); });
  root.make_later_checks();
  check_world(root, scene.world);
  return scene;
}

struct Reading {
  AnyScene scene;
  Diagnostics diagnostics;
};

template <int Dim>
Reading read_as(const toml::table& table, const Diagnostics& before) {
  Reading reading{Scene<Dim>(), before};
  TableReader::read_root(table, Dim, reading.diagnostics,
                         [&](TableReader& root) { reading.scene = read_root<Dim>(root); });
  return reading;
}

/// As the dimension that the file gives. If it gives none, as the one with fewer errors, so that the other errors can
/// be reported as well.
Reading read_table(const toml::table& table, const Diagnostics& before) {
  const auto* written = table["dimension"].as_integer();
  const std::int64_t dimension = written == nullptr ? 0 : **written;
  if (dimension == 2) return read_as<2>(table, before);
  if (dimension == 3) return read_as<3>(table, before);
  Reading flat = read_as<2>(table, before);
  Reading full = read_as<3>(table, before);
  return std::move(flat.diagnostics.errors.size() < full.diagnostics.errors.size() ? flat : full);
}

toml::table parse(std::string_view text, std::string_view file_name) {
  check_scene_text(text, std::string(file_name));
  try {
    return toml::parse(text, file_name);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw SceneErrors({{std::string(file_name), static_cast<int>(at.line), static_cast<int>(at.column), "", "",
                        std::string(error.description()), ""}});
  }
}

/// Of a file that is too large no more than shows it: it may be a device without end.
std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code unused;
  if (!stream || std::filesystem::is_directory(file, unused))
    throw SceneErrors({{file.string(), 0, 0, "", "", "no such file, or it cannot be read", ""}});
  const auto size = std::filesystem::file_size(file, unused);
  if (!unused) check_scene_text_size(size, file.string());
  std::string text(max_scene_text + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(stream.gcount());
  return text;
}

toml::table parse_file(const std::filesystem::path& file) { return parse(contents(file), file.string()); }

/// Comments are kept where no value was put in.
std::string as_run(std::string_view text, const toml::table& table, std::span<const Override> overrides,
                   bool includes) {
  if (overrides.empty() && !includes) return std::string(text);
  std::string as_toml;
  for (const Override& one : overrides) {
    std::string comment = one.text;
    std::erase_if(comment, [](unsigned char letter) { return std::iscntrl(letter) != 0; });
    as_toml += "# --set " + comment + "\n";
  }
  return as_toml + document_text(table);
}

}  // namespace

AnyScene parse_scene(std::string_view text, std::string_view file_name, std::span<const Override> overrides) {
  toml::table table = parse(text, file_name);
  Diagnostics diagnostics{.file = std::string(file_name)};
  const bool includes = put_in_included(table, file_name, diagnostics, parse_file);
  apply_overrides(table, overrides, diagnostics.errors);
  Reading reading = read_table(table, diagnostics);
  if (!reading.diagnostics.errors.empty()) throw SceneErrors(std::move(reading.diagnostics.errors));
  std::visit(
      [&](auto& scene) {
        scene.toml = as_run(text, table, overrides, includes);
        check_scene_text(scene.toml, "the scene with the values of --set");
        scene.folder = std::filesystem::path(file_name).parent_path();
        scene.referred = reading.diagnostics.referred;
        scene.included.assign(diagnostics.included.begin(), diagnostics.included.end());
        scene.reader_warnings = reading.diagnostics.warnings;
      },
      reading.scene);
  return std::move(reading.scene);
}

AnyScene read_scene(const std::filesystem::path& file, std::span<const Override> overrides) {
  return parse_scene(contents(file), file.string(), overrides);
}

std::set<std::string> keys_looked_for(std::string_view text) {
  return read_table(parse(text, "text"), {.file = "text", .fills = true}).diagnostics.keys;
}

std::string with_every_default(std::string_view text, std::string_view file_name) {
  Reading reading = read_table(parse(text, file_name), {.file = std::string(file_name), .fills = true});
  if (!reading.diagnostics.errors.empty()) throw SceneErrors(std::move(reading.diagnostics.errors));
  std::string filled;
  for (const FilledTable& table : reading.diagnostics.filled) {
    if (table.values.empty()) continue;
    if (!table.head.empty()) filled += fmt::format("\n{}\n", table.head);
    for (const auto& [key, value] : table.values) filled += fmt::format("{} = {}\n", key, value);
  }
  return filled;
}

}  // namespace talus

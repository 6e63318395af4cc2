#include "common/scene/read_root.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "common/scene/read_parts.h"
#include "common/scene/read_shape.h"
#include "common/scene/read_source.h"
#include "common/scene/read_world.h"

namespace talus {
namespace {

template <int Dim>
void read_shapes(TableReader& root, std::vector<std::string>& names, std::vector<Shape<Dim>>& shapes) {
  const bool well_formed = root.named_tables("shape", [&](const std::string& name, TableReader& table) {
    names.push_back(name);
    if (auto shape = read_body_shape<Dim>(table, name)) {
      shapes.push_back(std::move(*shape));
    }
  });
  if (well_formed && names.empty()) {
    root.reject("shape", "must be given: at least one [shape.NAME] to drop");
  }
}

template <int Dim>
void read_sources(TableReader& root, std::span<const std::string> shape_names, Scene<Dim>& scene) {
  std::int64_t bodies = 0;
  const bool well_formed = root.tables("source", [&](TableReader& table) {
    scene.sources.push_back(read_source<Dim>(table, shape_names, scene.world));
    bodies += scene.sources.back().count;
  });
  if (well_formed && scene.sources.empty()) {
    root.reject("source", "must be given: at least one [[source]], which drops the bodies");
  }
  if (bodies > most_bodies) {
    root.reject("source", fmt::format("must drop at most {} bodies together", most_bodies));
  }
}

// What only the whole world shows, as masses that are too different.
template <int Dim>
void check_world(TableReader& root, const WorldDescription<Dim>& world) {
  if (root.sound()) {
    try {
      check(world);
    } catch (const std::invalid_argument& refusal) {
      root.reject("shape", refusal.what());
    }
  }
}

}  // namespace

template <int Dim>
Scene<Dim> read_root(TableReader& root) {
  Scene<Dim> scene;
  root.require("title");
  root.read("title", scene.title);
  std::int64_t dimension = Dim;
  root.require("dimension");
  root.read("dimension", dimension, between(2, 3));
  read_seed(root, scene.seed);
  root.table("world", [&](TableReader& table) { read_world(table, scene.world); });
  root.table("skip", [&](TableReader& table) { read_skips(table, scene.world.skips); });
  root.table("ground", [&](TableReader& table) { read_ground(table, scene.world.ground); });
  root.tables("obstacle", [&](TableReader& table) { read_obstacle(table, scene.world.obstacles); });
  std::vector<std::string> shape_names;
  read_shapes(root, shape_names, scene.world.shapes);
  read_sources(root, shape_names, scene);
  root.tables("pile", [&](TableReader& table) { scene.piles.push_back(read_pile(table, scene.world.obstacles)); });
  root.table("policy", [&](TableReader& table) { read_policy(table, scene.policy); });
  scene.world.engine_sleep = scene.policy.kind == "engine";
  root.table("run", [&](TableReader& table) { read_run(table, scene.world.dt, scene.run); });
  check_world(root, scene.world);
  return scene;
}

template Scene<2> read_root(TableReader&);
template Scene<3> read_root(TableReader&);

}  // namespace talus

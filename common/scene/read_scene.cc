#include "common/scene/read_scene.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "common/scene/read_parts.h"
#include "common/scene/read_shape.h"
#include "common/scene/read_source.h"
#include "common/scene/read_world.h"
#include "common/scene/table_reader.h"

namespace talus {
namespace {

template <int Dim>
void read_shapes(TableReader& root, std::vector<std::string>& names, std::vector<Shape<Dim>>& shapes) {
  root.named_tables("shape", [&](const std::string& name, TableReader& table) {
    names.push_back(name);
    if (auto shape = read_body_shape<Dim>(table, name)) {
      shapes.push_back(std::move(*shape));
    }
  });
  if (names.empty()) {
    root.reject("shape", "must be given: at least one [shape.NAME] to drop");
  }
}

template <int Dim>
void read_sources(TableReader& root, std::span<const std::string> shape_names, Scene<Dim>& scene) {
  std::int64_t bodies = 0;
  root.tables("source", [&](TableReader& table) {
    scene.sources.push_back(read_source<Dim>(table, shape_names, scene.world));
    bodies += scene.sources.back().count;
  });
  if (scene.sources.empty()) {
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
  root.table("ground", [&](TableReader& table) { read_ground(table, scene.world.ground); });
  root.tables("obstacle", [&](TableReader& table) { read_obstacle(table, scene.world.obstacles); });
  std::vector<std::string> shape_names;
  read_shapes(root, shape_names, scene.world.shapes);
  read_sources(root, shape_names, scene);
  root.tables("pile", [&](TableReader& table) { scene.piles.push_back(read_pile<Dim>(table)); });
  root.table("policy", [&](TableReader& table) { read_policy(table, scene.policy); });
  scene.world.engine_sleep = scene.policy.kind == "engine";
  root.table("run", [&](TableReader& table) { read_run(table, scene.world.dt, scene.run); });
  check_world(root, scene.world);
  return scene;
}

struct Reading {
  AnyScene scene;
  Findings findings;
};

template <int Dim>
Reading read_as(const toml::table& table, const Findings& before) {
  Reading reading{Scene<Dim>(), before};
  TableReader::read_root(table, reading.findings, [&](TableReader& root) { reading.scene = read_root<Dim>(root); });
  return reading;
}

// As what the file says it is. If it does not say so, as the one in which it makes more sense, so that its other
// errors can be told as well.
Reading read_table(const toml::table& table, const Findings& before) {
  const std::int64_t dimension = table["dimension"].value_or(std::int64_t{0});
  if (dimension == 2) {
    return read_as<2>(table, before);
  }
  if (dimension == 3) {
    return read_as<3>(table, before);
  }
  Reading flat = read_as<2>(table, before);
  Reading full = read_as<3>(table, before);
  return flat.findings.errors.size() < full.findings.errors.size() ? flat : full;
}

toml::table parse(std::string_view text, std::string_view file_name) {
  try {
    return toml::parse(text, file_name);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw SceneErrors({{std::string(file_name), static_cast<int>(at.line), static_cast<int>(at.column), "", "",
                        std::string(error.description()), ""}});
  }
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code unused;
  if (!stream || std::filesystem::is_directory(file, unused)) {
    throw SceneErrors({{file.string(), 0, 0, "", "", "no such file, or it cannot be read", ""}});
  }
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// Comments are kept where nothing had to be put in.
std::string as_run(std::string_view text, const toml::table& table, std::span<const Override> overrides) {
  if (overrides.empty()) {
    return std::string(text);
  }
  std::ostringstream stream;
  for (const Override& one : overrides) {
    stream << "# --set " << one.text << "\n";
  }
  stream << table << "\n";
  return stream.str();
}

}  // namespace

AnyScene parse_scene(std::string_view text, std::string_view file_name, std::span<const Override> overrides) {
  toml::table table = parse(text, file_name);
  Findings findings{.file = std::string(file_name), .errors = {}, .keys = {}};
  apply_overrides(table, overrides, findings.errors);
  Reading reading = read_table(table, findings);
  if (!reading.findings.errors.empty()) {
    throw SceneErrors(std::move(reading.findings.errors));
  }
  std::visit([&](auto& scene) { scene.toml = as_run(text, table, overrides); }, reading.scene);
  return std::move(reading.scene);
}

AnyScene read_scene(const std::filesystem::path& file, std::span<const Override> overrides) {
  return parse_scene(contents(file), file.string(), overrides);
}

std::set<std::string> keys_looked_for(std::string_view text) {
  return read_table(parse(text, "text"), {.file = "text", .errors = {}, .keys = {}}).findings.keys;
}

}  // namespace talus

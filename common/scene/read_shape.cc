#include "common/scene/read_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "common/mesh/mesh_file.h"
#include "common/mesh/mesh_shape.h"
#include "common/mesh/parts_volume.h"
#include "common/scene/read_fields.h"
#include "common/scene/read_pieces.h"

namespace talus {
namespace {

constexpr std::string_view mesh_kind = "mesh";

template <int Dim>
std::optional<Shape<Dim>> read_mesh_shape(TableReader& table, const std::string& name, const Material& material) {
  std::filesystem::path file;
  MeshParams params;
  table.require("file");
  table.read("file", file, parts_file);
  table.read("longest_side", params.size, length());
  const std::vector<std::string> axes = {"y", "z"};
  std::string up = params.y_up ? "y" : "z";
  table.read("up", up, axes);
  params.y_up = up == "y";
  if constexpr (Dim == 2) {
    table.read("detail", params.detail, between(1e-3, 1e4));
  } else {
    table.refuse("detail", "means nothing where dimension = 3: `talus decompose` has made the parts");
  }
  if (!table.sound()) {
    return std::nullopt;
  }
  Shape<Dim> shape = make_mesh_shape<Dim>(name, file, params, material);
  if (!fills_mesh(shape.filling)) {
    table.warn(
        fmt::format("its parts have {:.3g} times the mesh's volume, which differs by more than {:.0f} %; "
                    "`talus decompose` makes closer ones",
                    shape.filling, 100.0 * parts_tolerance));
  }
  return shape;
}

template <int Dim>
std::optional<Shape<Dim>> read_any(TableReader& table, const std::string& kind, const std::string& name,
                                   const Material& material) {
  if (kind == mesh_kind) {
    return read_mesh_shape<Dim>(table, name, material);
  }
  for (const PiecesKind<Dim>& one : pieces_kinds<Dim>()) {
    if (one.name == kind) {
      std::vector<Piece<Dim>> pieces = one.read(table);
      return table.sound() ? std::optional(make_shape<Dim>(name, std::move(pieces), material)) : std::nullopt;
    }
  }
  return std::nullopt;
}

// Whether the engines can hold the shape, asked here so that the answer has its place in the file.
template <int Dim>
void check_alone(const Shape<Dim>& shape) {
  WorldDescription<Dim> world;
  world.shapes = {shape};
  check(world);
}

}  // namespace

template <int Dim>
std::vector<std::string> shape_kinds() {
  std::vector<std::string> names;
  for (const PiecesKind<Dim>& kind : pieces_kinds<Dim>()) {
    names.emplace_back(kind.name);
  }
  names.emplace_back(mesh_kind);
  return names;
}

template <int Dim>
std::optional<Shape<Dim>> read_shape(TableReader& table, const std::string& kind, const std::string& name,
                                     const Material& material) {
  try {
    std::optional<Shape<Dim>> shape = read_any<Dim>(table, kind, name, material);
    if (shape) {
      check_alone(*shape);
    }
    return shape;
  } catch (const std::invalid_argument& refusal) {
    table.reject_as(refusal);
    return std::nullopt;
  }
}

template <int Dim>
std::optional<Shape<Dim>> read_body_shape(TableReader& table, const std::string& name) {
  Material material;
  table.read("density", material.density, {.low = 0.0, .high = 1e6, .low_excluded = true});
  read_surface(table, material);
  return read_shape<Dim>(table, read_kind(table, shape_kinds<Dim>()), name, material);
}

template std::vector<std::string> shape_kinds<2>();
template std::vector<std::string> shape_kinds<3>();
template std::optional<Shape<2>> read_shape(TableReader&, const std::string&, const std::string&, const Material&);
template std::optional<Shape<3>> read_shape(TableReader&, const std::string&, const std::string&, const Material&);
template std::optional<Shape<2>> read_body_shape(TableReader&, const std::string&);
template std::optional<Shape<3>> read_body_shape(TableReader&, const std::string&);

}  // namespace talus

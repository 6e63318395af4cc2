#include "common/scene/read_shape.h"

#include <fmt/format.h>

#include <random>
#include <utility>

#include "common/mesh/mesh_file.h"
#include "common/mesh/mesh_shape.h"
#include "common/mesh/parts_volume.h"
#include "common/shape/catalogue.h"

namespace talus {
namespace {

constexpr std::string_view mesh_kind = "mesh";
constexpr std::string_view stone_kind = "stone";

/// A kind whose parameters are a struct with declared fields.
template <int Dim, typename Params>
ShapeKind<Dim> kind_of(std::string_view name, Fields<Params> fields,
                       std::vector<Piece<Dim>> (*make_pieces)(const Params&)) {
  return {name, [fields, make_pieces](TableReader& table) {
            Params params;
            table.read_fields(params, fields);
            return table.ok() ? make_pieces(params) : std::vector<Piece<Dim>>();
          }};
}

std::optional<Turn<2>> read_angle(TableReader& table) {
  if (!table.has("angle_deg")) return std::nullopt;
  Turn<2> turn;
  table.read(angle_key, turn.angle);
  return turn;
}

std::optional<Turn<3>> read_angle_about_axis(TableReader& table) {
  if (!table.has("angle_deg") && !table.has("axis")) return std::nullopt;
  Turn<3> turn;
  table.require("angle_deg");
  table.require("axis");
  table.read(angle_key, turn.angle);
  table.read(axis_key, turn.axis);
  if (turn.axis.norm() < 1e-6) {
    table.error("axis", "must have a length, of any size");
    return std::nullopt;
  }
  turn.axis.normalize();
  return turn;
}

template <int Dim>
std::optional<Shape<Dim>> read_mesh_shape(TableReader& table, const std::string& name, const Material& material) {
  std::filesystem::path file;
  MeshParams params;
  table.read("file", file, parts_file);
  table.read_fields(params, mesh_fields);
  if (!table.ok()) return std::nullopt;
  Shape<Dim> shape = make_mesh_shape<Dim>(name, file, params, material);
  if (!fills_mesh(shape.filling)) {
    table.warn(
        fmt::format("its parts have {:.3g} times the mesh's volume, which differs by more than {:.0f} %; "
                    "`talus decompose` makes closer ones",
                    shape.filling, 100.0 * parts_tolerance));
  }
  return shape;
}

/// The name of a variant, counted from 0.
std::string name_of_variant(const std::string& name, int variant) {
  return variant == 0 ? name : fmt::format("{}{}{}", name, variant_mark, variant + 1);
}

/// Stones of one name are the same in each scene of a seed, whatever other shapes it has.
template <int Dim>
std::vector<Shape<Dim>> read_stones(TableReader& table, const std::string& name, const Material& material,
                                    std::uint64_t seed) {
  StoneParams params;
  table.read_fields(params, stone_fields);
  std::vector<Shape<Dim>> stones;
  for (int variant = 0; table.ok() && variant < params.variants; ++variant) {
    std::vector<std::uint64_t> seeds = {seed, static_cast<std::uint64_t>(variant)};
    seeds.insert(seeds.end(), name.begin(), name.end());
    std::seed_seq sequence(seeds.begin(), seeds.end());
    std::mt19937_64 random(sequence);
    stones.push_back(make_shape<Dim>(name_of_variant(name, variant), stone_pieces<Dim>(params, random), material));
  }
  return stones;
}

template <int Dim>
std::vector<Shape<Dim>> read_any(TableReader& table, const std::string& kind, const std::string& name,
                                 const Material& material, std::uint64_t seed) {
  if (kind == stone_kind) return read_stones<Dim>(table, name, material, seed);
  if (kind == mesh_kind) {
    std::optional<Shape<Dim>> shape = read_mesh_shape<Dim>(table, name, material);
    return shape ? std::vector{std::move(*shape)} : std::vector<Shape<Dim>>();
  }
  for (const ShapeKind<Dim>& one : shape_kinds<Dim>()) {
    if (one.name == kind) {
      std::vector<Piece<Dim>> pieces = one.read(table);
      if (table.ok()) return {make_shape<Dim>(name, std::move(pieces), material)};
    }
  }
  return {};
}

/// Whether the engines can simulate the shapes: checked here, so that the error has its place in the file.
template <int Dim>
void check_alone(const std::vector<Shape<Dim>>& shapes) {
  WorldDescription<Dim> world;
  world.shapes = shapes;
  check(world);
}

}  // namespace

template <int Dim>
std::vector<ShapeKind<Dim>> shape_kinds() {
  using Pieces = std::vector<Piece<Dim>>;
  return {
      kind_of<Dim, BoxParams<Dim>>("box", box_fields<Dim>,
                                   [](const BoxParams<Dim>& box) -> Pieces { return box_pieces<Dim>(box.size); }),
      kind_of<Dim, LParams>("L", l_fields, l_pieces<Dim>),
      kind_of<Dim, BallParams>("ball", ball_fields,
                               [](const BallParams& ball) -> Pieces { return ball_pieces<Dim>(ball.radius); }),
      kind_of<Dim, CapsuleParams>(
          "capsule", capsule_fields,
          [](const CapsuleParams& capsule) -> Pieces { return capsule_pieces<Dim>(capsule.length, capsule.radius); }),
      kind_of<Dim, CylinderParams>("cylinder", cylinder_fields, cylinder_pieces<Dim>),
      kind_of<Dim, ConeParams>("cone", cone_fields, cone_pieces<Dim>),
      kind_of<Dim, EllipseParams<Dim>>("ellipse", ellipse_fields<Dim>, ellipse_pieces<Dim>),
      kind_of<Dim, HullParams<Dim>>(
          "hull", hull_fields<Dim>,
          [](const HullParams<Dim>& hull) -> Pieces { return hull_pieces<Dim>(hull.corners); }),
      kind_of<Dim, PolygonParams>(
          "polygon", polygon_fields,
          [](const PolygonParams& polygon) -> Pieces { return polygon_pieces<Dim>(polygon.corners, polygon.depth); }),
      kind_of<Dim, RingParams>("ring", ring_fields, ring_pieces<Dim>),
  };
}

template <int Dim>
std::vector<std::string> names_of_shape_kinds() {
  std::vector<std::string> names;
  for (const ShapeKind<Dim>& kind : shape_kinds<Dim>()) names.emplace_back(kind.name);
  names.emplace_back(stone_kind);
  names.emplace_back(mesh_kind);
  return names;
}

std::string read_kind(TableReader& table, const std::vector<std::string>& kinds) {
  std::string kind;
  table.require("kind");
  table.read("kind", kind, kinds);
  if (kind.empty()) table.allow_unknown_keys();  // which keys belong here depends on the kind
  return kind;
}

template <int Dim>
std::optional<Turn<Dim>> read_turn(TableReader& table) {
  if constexpr (Dim == 2) {
    table.forbid("axis", "means nothing where dimension = 2");
    return read_angle(table);
  } else {
    return read_angle_about_axis(table);
  }
}

template <int Dim>
std::optional<Rotation<Dim>> read_rotation(TableReader& table) {
  const std::optional<Turn<Dim>> turn = read_turn<Dim>(table);
  return turn ? std::optional(turn->rotation()) : std::nullopt;
}

template <int Dim>
std::vector<Shape<Dim>> read_shape(TableReader& table, const std::string& kind, const std::string& name,
                                   const Material& material, std::uint64_t seed) {
  std::vector<Shape<Dim>> shapes;
  table.check([&] {
    std::vector<Shape<Dim>> described = read_any<Dim>(table, kind, name, material, seed);
    if (!described.empty()) check_alone(described);
    shapes = std::move(described);
  });
  return shapes;
}

template <int Dim>
std::vector<Shape<Dim>> read_body_shape(TableReader& table, const std::string& name, std::uint64_t seed) {
  Material material;
  const std::string kind = read_kind(table, names_of_shape_kinds<Dim>());
  table.read_fields(material, body_material_fields);
  table.read_fields(material, surface_fields);
  return read_shape<Dim>(table, kind, name, material, seed);
}

template std::vector<ShapeKind<2>> shape_kinds<2>();
template std::vector<ShapeKind<3>> shape_kinds<3>();
template std::vector<std::string> names_of_shape_kinds<2>();
template std::vector<std::string> names_of_shape_kinds<3>();
template std::optional<Turn<2>> read_turn<2>(TableReader&);
template std::optional<Turn<3>> read_turn<3>(TableReader&);
template std::optional<Rotation<2>> read_rotation<2>(TableReader&);
template std::optional<Rotation<3>> read_rotation<3>(TableReader&);
template std::vector<Shape<2>> read_shape(TableReader&, const std::string&, const std::string&, const Material&,
                                          std::uint64_t);
template std::vector<Shape<3>> read_shape(TableReader&, const std::string&, const std::string&, const Material&,
                                          std::uint64_t);
template std::vector<Shape<2>> read_body_shape(TableReader&, const std::string&, std::uint64_t);
template std::vector<Shape<3>> read_body_shape(TableReader&, const std::string&, std::uint64_t);

}  // namespace talus

#include "common/scene/read_shape.h"

#include <fmt/format.h>

#include <random>
#include <utility>

#include "common/math/random.h"
#include "common/mesh/mesh_file.h"
#include "common/mesh/parts_volume.h"
#include "common/scene/accuracy.h"
#include "common/scene/overlap.h"
#include "common/shape/catalogue.h"
#include "common/shape/colour.h"
#include "common/shape/convex_distance.h"
#include "common/shape/convex_piece.h"
#include "common/shape/shape_fields.h"
#include "common/world/scaled_world.h"

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
    std::vector<std::uint64_t> numbers = {static_cast<std::uint64_t>(variant)};
    numbers.insert(numbers.end(), name.begin(), name.end());
    std::mt19937_64 random = generator_of(seed, numbers);
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

}  // namespace

template <int Dim>
void check_alone(const std::vector<Shape<Dim>>& shapes) {
  WorldDescription<Dim> world;
  world.shapes = shapes;
  world.units = fitting_units(world);
  world.dt = 1.0 / usual_steps_per_second(world);
  check(world);
}

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

namespace {

std::string names_of_colours() {
  std::vector<std::string_view> names;
  for (const auto& [name, colour] : named_colours) names.push_back(name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Depth [m] of the deepest overlap of the pieces of two parts.
template <int Dim>
double overlap_of(const CompoundPart<Dim>& a, const CompoundPart<Dim>& b) {
  double deepest = 0.0;
  const std::vector<ConvexPiece<Dim>> others = convex_pieces_at(b.shape, b.pose);
  for (const ConvexPiece<Dim>& one : convex_pieces_at(a.shape, a.pose))
    for (const ConvexPiece<Dim>& other : others) deepest = std::max(deepest, -signed_distance(one, other, 0.0));
  return deepest;
}

template <int Dim>
void warn_of_overlap(TableReader& table, const std::vector<CompoundPart<Dim>>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double depth = overlap_of(parts[i], parts[j]);
      if (depth > most_overlap * std::min(1.0, parts[i].shape.extent))
        table.warn(
            fmt::format("parts[{}] and parts[{}] overlap by {:.3g} m, where the mass of both counts", j, i, depth));
    }
  }
}

}  // namespace

template <int Dim>
std::optional<CompoundPart<Dim>> BodyShapes<Dim>::read_part(TableReader& table) {
  PartParams<Dim> params;
  table.require("shape");
  table.read("shape", params.shape, names_);
  table.read_fields(params, part_fields<Dim>);
  const Rotation<Dim> rotation = read_rotation<Dim>(table).value_or(identity_rotation<Dim>());
  if (!table.ok()) return std::nullopt;
  if (std::ranges::count(under_way_, params.shape) > 0) {
    table.error("shape", fmt::format("must not have this shape as a part: {} has {}", fmt::join(under_way_, " has "),
                                     params.shape));
    return std::nullopt;
  }
  constexpr std::size_t deepest = 8;
  if (under_way_.size() > deepest) {
    table.error("shape", fmt::format("must not be the {}th compound inside another", deepest + 1));
    return std::nullopt;
  }
  parts_.insert(params.shape);
  root_.named_table("shape", params.shape, [&](TableReader& own) {
    if (done_.contains(params.shape))
      own.allow_unknown_keys();
    else
      read(params.shape, own);
  });
  const std::vector<Shape<Dim>>& variants = done_[params.shape];
  if (variants.empty()) return std::nullopt;
  return CompoundPart<Dim>{variants.front(), pose_of_centre(variants.front(), {params.position, rotation})};
}

template <int Dim>
std::vector<Shape<Dim>> BodyShapes<Dim>::read_compound(const std::string& name, TableReader& table) {
  Material surface;
  constexpr std::span<const Field<Material>> fields = body_material_fields;
  table.forbid("density", "means nothing for a compound: each part has its own");
  table.read_fields(surface, fields.subspan(1));
  table.read_fields(surface, surface_fields);
  std::vector<CompoundPart<Dim>> parts;
  bool complete = true;
  table.require("parts");
  table.tables("parts", [&](TableReader& own) {
    std::optional<CompoundPart<Dim>> part = read_part(own);
    complete = complete && part.has_value();
    if (part) parts.push_back(std::move(*part));
  });
  if (table.ok() && parts.empty() && complete) table.error("parts", "must be one or more parts");
  constexpr std::size_t most_pieces = 1000;
  std::size_t pieces = 0;
  for (const CompoundPart<Dim>& part : parts) pieces += part.shape.pieces.size();
  if (pieces > most_pieces) table.error("parts", fmt::format("must have at most {} convex pieces", most_pieces));
  std::vector<Shape<Dim>> shapes;
  if (!complete || !table.ok()) return shapes;
  table.check([&] {
    shapes = {make_compound(name, parts, surface)};
    check_alone(shapes);
  });
  if (!table.ok()) return {};
  warn_of_overlap(table, parts);
  return shapes;
}

template <int Dim>
std::vector<Shape<Dim>> BodyShapes<Dim>::read_anew(const std::string& name, TableReader& table) {
  std::vector<std::string> kinds = names_of_shape_kinds<Dim>();
  kinds.emplace_back(compound_kind);
  const std::string kind = read_kind(table, kinds);
  if (kind == compound_kind) return read_compound(name, table);
  Material material;
  table.read_fields(material, body_material_fields);
  table.read_fields(material, surface_fields);
  return read_shape<Dim>(table, kind, name, material, seed_);
}

template <int Dim>
const std::vector<Shape<Dim>>& BodyShapes<Dim>::read(const std::string& name, TableReader& table) {
  if (done_.contains(name)) {
    table.allow_unknown_keys();
    return done_[name];
  }
  under_way_.push_back(name);
  std::optional<std::string> colour;
  table.read(colour_key, colour);
  std::vector<Shape<Dim>> shapes = read_anew(name, table);
  under_way_.pop_back();
  if (colour) {
    const std::optional<std::string> text = colour_text(*colour);
    if (!text) table.error("colour", "must be \"#rrggbb\" or one of " + names_of_colours());
    for (Shape<Dim>& shape : shapes) shape.colour = text.value_or("");
  }
  return done_[name] = std::move(shapes);
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
template class BodyShapes<2>;
template class BodyShapes<3>;

template void check_alone(const std::vector<Shape<2>>&);
template void check_alone(const std::vector<Shape<3>>&);

}  // namespace talus

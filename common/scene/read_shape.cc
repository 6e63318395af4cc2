#include "common/scene/read_shape.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "common/scene/read_fields.h"
#include "common/shape/catalogue.h"

namespace talus {
namespace {

template <int Dim>
std::vector<Piece<Dim>> read_box(TableReader& table) {
  const Vec<Dim> size = read_size<Dim>(table, "size");
  return table.sound() ? box_pieces<Dim>(size) : std::vector<Piece<Dim>>();
}

template <int Dim>
std::vector<Piece<Dim>> read_l(TableReader& table) {
  LParams params;
  table.read("arm_x", params.arm_x, length());
  table.read("arm_z", params.arm_z, length());
  table.read("thickness", params.thickness, length());
  if constexpr (Dim == 3) {
    table.read("depth", params.depth, length());
  } else {
    table.refuse("depth", "means nothing where dimension = 2");
  }
  return table.sound() ? l_pieces<Dim>(params) : std::vector<Piece<Dim>>();
}

template <int Dim>
std::vector<Piece<Dim>> read_ball(TableReader& table) {
  double radius = 0.5;
  table.require("radius");
  table.read("radius", radius, length());
  return table.sound() ? ball_pieces<Dim>(radius) : std::vector<Piece<Dim>>();
}

template <int Dim>
std::vector<Piece<Dim>> read_capsule(TableReader& table) {
  double from_tip_to_tip = 1.0;
  double radius = 0.25;
  table.require("length");
  table.require("radius");
  table.read("length", from_tip_to_tip, length());
  table.read("radius", radius, length());
  return table.sound() ? capsule_pieces<Dim>(from_tip_to_tip, radius) : std::vector<Piece<Dim>>();
}

template <int Dim>
std::vector<Piece<Dim>> read_hull(TableReader& table) {
  std::vector<Vec<Dim>> corners;
  table.require("corners");
  table.read("corners", corners, coordinate());
  return table.sound() ? hull_pieces<Dim>(corners) : std::vector<Piece<Dim>>();
}

template <int Dim>
struct Kind {
  std::string_view name;
  std::vector<Piece<Dim>> (*read)(TableReader& table);  // may throw std::invalid_argument
};

template <int Dim>
constexpr Kind<Dim> all_kinds[] = {
    {"box", read_box<Dim>},         {"L", read_l<Dim>},       {"ball", read_ball<Dim>},
    {"capsule", read_capsule<Dim>}, {"hull", read_hull<Dim>},
};

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
  for (const Kind<Dim>& kind : all_kinds<Dim>) {
    names.emplace_back(kind.name);
  }
  return names;
}

template <int Dim>
std::optional<Shape<Dim>> read_shape(TableReader& table, const std::string& kind, const std::string& name,
                                     const Material& material) {
  const auto* found = std::find_if(std::begin(all_kinds<Dim>), std::end(all_kinds<Dim>),
                                   [&](const Kind<Dim>& one) { return one.name == kind; });
  if (found == std::end(all_kinds<Dim>)) {
    return std::nullopt;
  }
  try {
    std::vector<Piece<Dim>> pieces = found->read(table);
    if (table.sound()) {
      Shape<Dim> shape = make_shape<Dim>(name, std::move(pieces), material);
      check_alone(shape);
      return shape;
    }
  } catch (const std::invalid_argument& refusal) {
    table.reject_as(refusal);
  }
  return std::nullopt;
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

#include "common/scene/read_pieces.h"

#include "common/scene/read_fields.h"
#include "common/shape/catalogue.h"

namespace talus {
namespace {

// A number that means something in space only.
template <int Dim, typename Number>
void read_in_space(TableReader& table, std::string_view key, Number& value, const Range& range) {
  if constexpr (Dim == 3) {
    table.read(key, value, range);
  } else {
    table.refuse(key, "means nothing where dimension = 2");
  }
}

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
  read_in_space<Dim>(table, "depth", params.depth, length());
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
std::vector<Piece<Dim>> read_polygon(TableReader& table) {
  std::vector<Vec2> corners;
  double depth = 0.4;
  table.require("corners");
  table.read("corners", corners, coordinate());
  read_in_space<Dim>(table, "depth", depth, length());
  return table.sound() ? polygon_pieces<Dim>(corners, depth) : std::vector<Piece<Dim>>();
}

template <int Dim>
std::vector<Piece<Dim>> read_ring(TableReader& table) {
  RingParams params;
  table.require("outer_radius");
  table.require("inner_radius");
  table.read("outer_radius", params.outer_radius, length());
  table.read("inner_radius", params.inner_radius, length());
  table.read("parts", params.parts, between(3, 64));
  read_in_space<Dim>(table, "depth", params.depth, length());
  read_in_space<Dim>(table, "section_corners", params.section_corners, between(4, 8));
  return table.sound() ? ring_pieces<Dim>(params) : std::vector<Piece<Dim>>();
}

}  // namespace

template <int Dim>
std::vector<PiecesKind<Dim>> pieces_kinds() {
  return {{"box", read_box<Dim>},         {"L", read_l<Dim>},       {"ball", read_ball<Dim>},
          {"capsule", read_capsule<Dim>}, {"hull", read_hull<Dim>}, {"polygon", read_polygon<Dim>},
          {"ring", read_ring<Dim>}};
}

template std::vector<PiecesKind<2>> pieces_kinds();
template std::vector<PiecesKind<3>> pieces_kinds();

}  // namespace talus

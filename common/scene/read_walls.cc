#include "common/scene/read_walls.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "common/scene/container.h"
#include "common/scene/convex_container.h"
#include "common/scene/read_fields.h"
#include "common/shape/polygon.h"

namespace talus {
namespace {

// `corners` of a convex polygon, counter-clockwise; noted and empty if they are none.
std::vector<Vec2> read_outline(TableReader& table) {
  std::vector<Vec2> corners;
  table.require("corners");
  table.read("corners", corners, coordinate());
  if (signed_area(corners) < 0.0) {
    std::reverse(corners.begin(), corners.end());
  }
  if (table.sound() && (corners.size() < 3 || non_convex_corner(corners))) {
    table.reject("corners", "must be three or more corners of a convex polygon, in order");
  }
  return table.sound() ? corners : std::vector<Vec2>();
}

double read_radius(TableReader& table) {
  double radius = 1.0;
  table.require("radius");
  table.read("radius", radius, length());
  return radius;
}

template <int Dim>
std::vector<Obstacle<Dim>> read_box_container(TableReader& table, const Pose<Dim>& pose, const Material& material) {
  ContainerParams<Dim> params;
  params.inner_size = read_size<Dim>(table, "inner_size");
  table.read("wall", params.wall, length());
  table.read("floor", params.floor);
  return table.sound() ? container_walls(params, pose, material) : std::vector<Obstacle<Dim>>();
}

std::vector<Obstacle<3>> read_convex_container(TableReader& table, const Pose<3>& pose, const Material& material) {
  ConvexContainerParams params;
  table.refuse("inner_size", "must not be given beside radius or corners");
  if (table.has("radius")) {
    table.refuse("corners", "must not be given beside radius");
    params.outline = round_outline(read_radius(table));
  } else {
    params.outline = read_outline(table);
  }
  table.require("height");
  table.read("height", params.height, length());
  table.read("wall", params.wall, length());
  table.read("floor", params.floor);
  return table.sound() ? convex_container_walls(params, pose, material) : std::vector<Obstacle<3>>();
}

// The boundary and its outline, which is needed to build it: of a box the full widths, else corners.
template <int Dim>
struct Outlined {
  Boundary<Dim> boundary{};
  Horizontal<Dim> size = Horizontal<Dim>::Zero();
  std::vector<Vec2> corners{};
};

template <int Dim>
Outlined<Dim> read_outlined(TableReader& table, const std::string& kind, double rim) {
  Outlined<Dim> outlined{.boundary = {.rim = rim}};
  if (kind == "box") {
    outlined.size.setOnes();
    table.require("size");
    table.read("size", outlined.size, length());
    outlined.boundary = box_boundary<Dim>(outlined.size, rim);
  }
  if constexpr (Dim == 3) {
    if (kind == "cylinder") {
      outlined.boundary.cylinder_radius = read_radius(table);
      outlined.corners = round_outline(outlined.boundary.cylinder_radius);
    } else if (kind == "convex") {
      outlined.corners = read_outline(table);
      outlined.boundary = convex_boundary(outlined.corners, rim);
    }
  }
  return outlined;
}

template <int Dim>
std::vector<Obstacle<Dim>> build(const Outlined<Dim>& outlined, double wall, bool floor, const Vec<Dim>& at,
                                 const Material& material) {
  Pose<Dim> pose;
  pose.position = at;
  if constexpr (Dim == 3) {
    if (!outlined.corners.empty()) {
      return convex_container_walls({outlined.corners, outlined.boundary.rim, wall, floor}, pose, material);
    }
  }
  ContainerParams<Dim> params{.wall = wall, .floor = floor};
  params.inner_size << outlined.size, outlined.boundary.rim;
  return container_walls(params, pose, material);
}

}  // namespace

template <int Dim>
std::vector<Obstacle<Dim>> read_container(TableReader& table, const Pose<Dim>& pose, const Material& material) {
  if constexpr (Dim == 3) {
    if (table.has("radius") || table.has("corners")) {
      return read_convex_container(table, pose, material);
    }
    table.refuse("height", "must be given as the last number of inner_size");
  }
  return read_box_container<Dim>(table, pose, material);
}

template <int Dim>
Boundary<Dim> read_boundary(TableReader& table, const Vec<Dim>& at, std::vector<Obstacle<Dim>>& obstacles) {
  std::vector<std::string> kinds = {"box"};
  if constexpr (Dim == 3) {
    kinds.insert(kinds.end(), {"cylinder", "convex"});
  }
  const std::string kind = read_kind(table, kinds);
  double rim = 1.0;
  double wall = 1.0;
  bool floor = false;
  Material material;
  table.require("rim");
  table.read("rim", rim, length());
  table.read("floor", floor);
  read_surface(table, material);
  const bool built = table.has("wall");
  if (!built) {
    table.refuse("floor", "means nothing without wall, since no walls are built");
  }
  table.read("wall", wall, length());
  try {
    const Outlined<Dim> outlined = read_outlined<Dim>(table, kind, rim);
    if (built && table.sound()) {
      const std::vector<Obstacle<Dim>> walls = build(outlined, wall, floor, at, material);
      obstacles.insert(obstacles.end(), walls.begin(), walls.end());
    }
    return outlined.boundary;
  } catch (const std::invalid_argument& refusal) {
    table.reject_as(refusal);
    return {};
  }
}

template std::vector<Obstacle<2>> read_container(TableReader&, const Pose<2>&, const Material&);
template std::vector<Obstacle<3>> read_container(TableReader&, const Pose<3>&, const Material&);
template Boundary<2> read_boundary(TableReader&, const Vec<2>&, std::vector<Obstacle<2>>&);
template Boundary<3> read_boundary(TableReader&, const Vec<3>&, std::vector<Obstacle<3>>&);

}  // namespace talus

#include "common/scene/read_obstacle.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "common/scene/read_motion.h"
#include "common/shape/polygon.h"
#include "common/shape/shape_fields.h"

namespace talus {
namespace {

/// `corners` of a convex polygon, counter-clockwise; empty, with an error, if they are none.
std::vector<Vec2> read_outline(TableReader& table) {
  std::vector<Vec2> corners;
  table.read(outline_corners_key, corners);
  if (signed_area(corners) < 0.0) std::reverse(corners.begin(), corners.end());
  if (table.ok() && (corners.size() < 3 || non_convex_corner(corners)))
    table.error("corners", "must be three or more corners of a convex polygon, in order");
  return table.ok() ? corners : std::vector<Vec2>();
}

double read_radius(TableReader& table) {
  double radius = 1.0;
  table.read(outline_radius_key, radius);
  return radius;
}

std::vector<Obstacle<3>> read_convex_container(TableReader& table, const Pose<3>& pose, const Material& material) {
  ConvexContainerParams params;
  table.forbid("inner_size", "must not be given beside radius or corners");
  if (table.has("radius")) {
    table.forbid("corners", "must not be given beside radius");
    params.outline = round_outline(read_radius(table));
  } else {
    params.outline = read_outline(table);
  }
  table.read_fields(params, convex_container_fields);
  return table.ok() ? convex_container_walls(params, pose, material) : std::vector<Obstacle<3>>();
}

template <int Dim>
std::vector<Obstacle<Dim>> read_container(TableReader& table, const Pose<Dim>& pose, const Material& material) {
  if constexpr (Dim == 3) {
    if (table.has("radius") || table.has("corners")) return read_convex_container(table, pose, material);
    table.forbid("height", "must be given as the last number of inner_size");
  }
  ContainerParams<Dim> params;
  table.read_fields(params, container_fields<Dim>);
  return table.ok() ? container_walls(params, pose, material) : std::vector<Obstacle<Dim>>();
}

/// The boundary and its outline, which is needed to build it: of a box the full widths, else corners.
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
    table.read(boundary_size_key, outlined.size);
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
std::vector<Obstacle<Dim>> build(const Outlined<Dim>& outlined, const BoundaryParams& params, const Vec<Dim>& at,
                                 const Material& material) {
  Pose<Dim> pose;
  pose.position = at;
  ContainerParams<Dim> box{.wall = *params.wall, .floor = params.floor.value_or(false)};
  if constexpr (Dim == 3) {
    if (!outlined.corners.empty())
      return convex_container_walls({outlined.corners, params.rim, box.wall, box.floor}, pose, material);
  }
  box.inner_size << outlined.size, params.rim;
  return container_walls(box, pose, material);
}

/// The obstacles of one table, which will be appended to those of the scene, move as one.
template <int Dim>
void read_mover(TableReader& table, const Vec<Dim>& pivot, std::vector<Obstacle<Dim>>& obstacles, Scene<Dim>& scene) {
  double reach = 0.0;
  for (Obstacle<Dim>& obstacle : obstacles) {
    obstacle.moves = true;
    reach = std::max(reach, (obstacle.pose.position - pivot).norm() + bounding_radius(obstacle.shape));
  }
  table.table("motion", [&](TableReader& own) {
    scene.movers.push_back({.first = static_cast<int>(scene.world.obstacles.size()),
                            .count = static_cast<int>(obstacles.size()),
                            .pivot = pivot,
                            .motion = read_motion<Dim>(own, pivot, reach, scene.world)});
  });
}

void read_name(TableReader& table, int first, int count, std::vector<ObstacleName>& names) {
  if (!table.has("name")) return;
  ObstacleName own{.name = {}, .first = first, .count = count};
  table.read({.name = "name"}, own.name);
  if (std::ranges::find(names, own.name, &ObstacleName::name) != names.end())
    table.error("name", "must be of no other obstacle");
  names.push_back(own);
}

}  // namespace

template <int Dim>
void read_obstacle(TableReader& table, Scene<Dim>& scene) {
  std::vector<std::string> kinds = names_of_shape_kinds<Dim>();
  kinds.emplace_back("container");
  const std::string kind = read_kind(table, kinds);
  Pose<Dim> pose;
  Material material;
  table.read_fields(pose, obstacle_fields<Dim>);
  pose.rotation = read_rotation<Dim>(table).value_or(pose.rotation);
  table.read_fields(material, surface_fields);
  WorldDescription<Dim> alone;
  table.check([&] {
    if (kind == "container")
      alone.obstacles = read_container(table, pose, material);
    else if (const auto shapes = read_shape<Dim>(table, kind, table.path(), material, scene.seed); !shapes.empty())
      alone.obstacles = {{shapes.front(), pose_of_centre(shapes.front(), pose)}};
  });
  // Here the error has its place in the file; check(WorldDescription) gives none.
  table.check_later([obstacles = alone.obstacles, &units = scene.world.units](TableReader& complete) {
    complete.check([&] {
      for (std::size_t i = 0; i < obstacles.size(); ++i)
        check(obstacles[i], units, fmt::format("world.obstacles[{}]", i));
    });
  });
  if (table.has("motion")) read_mover(table, pose.position, alone.obstacles, scene);
  std::vector<Obstacle<Dim>>& obstacles = scene.world.obstacles;
  read_name(table, static_cast<int>(obstacles.size()), static_cast<int>(alone.obstacles.size()), scene.obstacle_names);
  obstacles.insert(obstacles.end(), alone.obstacles.begin(), alone.obstacles.end());
  scene.obstacles_of_tables.push_back(static_cast<int>(alone.obstacles.size()));
}

template <int Dim>
Boundary<Dim> read_boundary(TableReader& table, const Vec<Dim>& at, std::vector<Obstacle<Dim>>& obstacles) {
  std::vector<std::string> kinds = {"box"};
  if constexpr (Dim == 3) kinds.insert(kinds.end(), {"cylinder", "convex"});
  const std::string kind = read_kind(table, kinds);
  BoundaryParams params;
  Material material;
  Boundary<Dim> boundary;
  if (!table.has("wall")) table.forbid("floor", "means nothing without wall, since no walls are built");
  table.read_fields(params, boundary_fields);
  table.read_fields(material, surface_fields);
  table.check([&] {
    const Outlined<Dim> outlined = read_outlined<Dim>(table, kind, params.rim);
    boundary = outlined.boundary;
    if (!params.wall || !table.ok()) return;
    const std::vector<Obstacle<Dim>> walls = build(outlined, params, at, material);
    obstacles.insert(obstacles.end(), walls.begin(), walls.end());
  });
  return boundary;
}

template void read_obstacle(TableReader&, Scene<2>&);
template void read_obstacle(TableReader&, Scene<3>&);
template Boundary<2> read_boundary(TableReader&, const Vec<2>&, std::vector<Obstacle<2>>&);
template Boundary<3> read_boundary(TableReader&, const Vec<3>&, std::vector<Obstacle<3>>&);

}  // namespace talus

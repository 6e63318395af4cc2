#include "common/scene/read_world.h"

#include <utility>

#include "common/scene/read_fields.h"
#include "common/scene/read_shape.h"
#include "common/scene/read_walls.h"

namespace talus {
namespace {

void read_solver(TableReader& table, SolverParams& solver) {
  table.read("velocity_iterations", solver.velocity_iterations, between(1, 1000));
  table.read("position_iterations", solver.position_iterations, between(1, 1000));
  table.read("friction_directions", solver.friction_directions, between(1, 2));
  table.read("warm_friction", solver.warm_friction);
  table.read("restitution_threshold", solver.restitution_threshold, between(0.0, 1e3));
}

// The pose that brings the origin of the axes in which the shape was described to `pose`.
template <int Dim>
Pose<Dim> pose_of_centre(const Shape<Dim>& shape, const Pose<Dim>& pose) {
  return {pose * Vec<Dim>(-shape.reference), pose.rotation};
}

}  // namespace

template <int Dim>
void read_world(TableReader& table, WorldDescription<Dim>& world) {
  table.read("gravity", world.gravity, between(0.0, 1e3));
  table.refuse("dt", "must be given as its inverse, as in steps_per_second = 60");
  if (table.has("steps_per_second")) {
    double steps_per_second = 60.0;
    table.read("steps_per_second", steps_per_second, between(30.0, 1e5));
    world.dt = 1.0 / steps_per_second;
  }
  table.table("solver", [&](TableReader& solver) { read_solver(solver, world.solver); });
}

void read_skips(TableReader& table, Skips& skips) {
  for (const Skip& skip : all_skips) {
    table.read(skip.name, skips.*skip.field);
  }
}

void read_ground(TableReader& table, Ground& ground) {
  table.read("present", ground.present);
  table.read("height", ground.height, coordinate());
  read_surface(table, ground.material);
}

template <int Dim>
void read_obstacle(TableReader& table, std::vector<Obstacle<Dim>>& obstacles) {
  Pose<Dim> pose;
  Material material;
  table.read("position", pose.position, coordinate());
  pose.rotation = read_rotation<Dim>(table).value_or(pose.rotation);
  read_surface(table, material);
  std::vector<std::string> kinds = shape_kinds<Dim>();
  kinds.emplace_back("container");
  const std::string kind = read_kind(table, kinds);
  WorldDescription<Dim> alone;
  try {
    if (kind == "container") {
      alone.obstacles = read_container(table, pose, material);
    } else if (const auto shape = read_shape<Dim>(table, kind, table.path(), material)) {
      alone.obstacles = {{*shape, pose_of_centre(*shape, pose)}};
    }
    check(alone);  // here, so that the error has its place in the file
  } catch (const std::invalid_argument& refusal) {
    table.reject_as(refusal);
  }
  obstacles.insert(obstacles.end(), alone.obstacles.begin(), alone.obstacles.end());
}

template void read_world(TableReader&, WorldDescription<2>&);
template void read_world(TableReader&, WorldDescription<3>&);
template void read_obstacle(TableReader&, std::vector<Obstacle<2>>&);
template void read_obstacle(TableReader&, std::vector<Obstacle<3>>&);

}  // namespace talus

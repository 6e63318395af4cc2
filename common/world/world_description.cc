#include "common/world/world_description.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/math/require.h"
#include "common/shape/piece.h"
#include "common/world/engine_traits.h"
#include "common/world/world_fields.h"

namespace talus {
namespace {

constexpr double least_mass = 1e-20;  // [kg], and of inertia [kg m^2]: single precision must hold products of inverses

/// The texts are made only where they are needed: bodies get velocities in many steps.
template <int Dim>
void check_pose(const Pose<Dim>& pose, const UnitScale& units, const std::string& field) {
  const double farthest = farthest_place(units);
  for (int axis = 0; axis < Dim; ++axis)
    if (!(std::abs(pose.position[axis]) <= farthest))
      require(false, fmt::format("{}.position[{}]", field, axis), pose.position[axis],
              fmt::format("must be within {:.6g} m of the origin", farthest));
  check_rotation<Dim>(pose.rotation, field + ".rotation");
}

/// Of all parts of bodies and obstacles, in the units of the engine.
template <int Dim>
void check_widths(const Shape<Dim>& shape, const UnitScale& units, const std::string& field) {
  const double least = thinnest_piece<Dim> / units.lengths();
  const std::string_view why =
      Dim == 2 ? "Box2D's contacts keep a gap of that size" : "Bullet's contacts miss what is thinner";
  for (std::size_t i = 0; i < shape.pieces.size(); ++i) {
    const double width = smallest_width(shape.pieces[i]);
    require(width >= least, fmt::format("{}.pieces[{}] width", field, i), width,
            fmt::format("must be at least {:.3g} m beside the smallest body: {}", least, why));
  }
}

template <int Dim>
void check_shape(const Shape<Dim>& shape, const UnitScale& units, const std::string& field) {
  require(!shape.pieces.empty(), field + ".pieces.size", 0.0, "must be one piece or more");
  check_material(shape.material, field + ".material");
  for (std::size_t i = 0; i < shape.pieces.size(); ++i)
    check_piece(shape.pieces[i], fmt::format("{}.pieces[{}]", field, i));
  require(std::isfinite(shape.mass) && shape.mass >= least_mass, field + ".mass", shape.mass,
          fmt::format("must be finite and at least {} kg", least_mass));
  const double least_inertia = std::pow(units.lengths(), 2) * shape.inertia.diagonal().minCoeff();
  require(shape.inertia.allFinite() && least_inertia >= least_mass && shape.inertia.determinant() > 0.0,
          field + ".inertia", least_inertia, fmt::format("must be finite and at least {} kg m^2", least_mass));
  require(shape.extent <= 2.0 * farthest_place(units), field + ".extent", shape.extent,
          fmt::format("must be at most {:.6g} m", 2.0 * farthest_place(units)));
}

template <int Dim>
void check_masses(const std::vector<Shape<Dim>>& shapes) {
  const auto lighter = [](const auto& a, const auto& b) { return a.mass < b.mass; };
  const auto [light, heavy] = std::minmax_element(shapes.begin(), shapes.end(), lighter);
  if (light != shapes.end()) {
    require(heavy->mass <= largest_mass_ratio_of_all * light->mass,
            fmt::format("mass of shape '{}' over mass of shape '{}'", heavy->name, light->name),
            heavy->mass / light->mass,
            fmt::format("must be at most {:g}, with the engines' own solvers better 10", largest_mass_ratio_of_all));
  }
}

}  // namespace

std::string solved_by(std::string_view backend, std::string_view solver_kind) {
  return solver_kind == engine_solver ? fmt::format("{} with its own solver", backend) : std::string(backend);
}

template <int Dim>
void check(const Obstacle<Dim>& obstacle, const UnitScale& units, const std::string& field) {
  check_shape(obstacle.shape, units, field + ".shape");
  check_pose(obstacle.pose, units, field + ".pose");
}

template <int Dim>
void check_step(const WorldDescription<Dim>& description, const UnitScale& units) {
  const double fewest_steps = fewest_steps_per_second * units.times();
  require(description.dt <= (1.0 + 1e-9) / fewest_steps, "world.steps_per_second", 1.0 / description.dt,
          fmt::format("must be at least {:g} for bodies of this size", fewest_steps));
}

/// That images of one body never come near each other, nor two images of one body near another one.
template <int Dim>
void check_sides(const WorldDescription<Dim>& description) {
  constexpr double least = 4.0;  // in extents of the largest body
  double extent = 0.0;
  for (const Shape<Dim>& shape : description.shapes) extent = std::max(extent, shape.extent);
  const Periodic<Dim> sides = description.periodic();
  require(Dim == 3 || !description.periodic_y, "world.periodic_y", 2, "must not be given in 2D");
  for (int axis = 0; axis < Dim - 1; ++axis) {
    if (!(axis == 0 ? description.periodic_x : description.periodic_y)) continue;
    const std::string field = axis == 0 ? "world.periodic_x" : "world.periodic_y";
    require(sides.period[axis] > 0.0 && sides.period[axis] >= least * extent, field, sides.period[axis],
            fmt::format("must be sides that are at least {:.6g} m apart, {:g} extents of the largest body",
                        least * extent, least));
    require(description.solver.small_steps(), field, fmt::format("\"{}\"", description.solver.kind),
            R"(must not be given with a solver other than "small_steps")");
  }
}

template <int Dim>
void check(const WorldDescription<Dim>& description) {
  check_fields(description, world_fields<Dim>, "world");
  check_step(description, description.units);
  check_fields(description.solver, solver_fields, "world.solver");
  require(!description.engine_sleep || !description.solver.small_steps(), "world.solver.kind",
          fmt::format("\"{}\"", description.solver.kind),
          R"(must be "engine" with the policy "engine": the engine's own sleep follows its own solver)");
  if (description.ground.present) {
    check_fields(description.ground, ground_fields, "world.ground");
    check_material(description.ground.material, "world.ground.material");
  }
  for (std::size_t i = 0; i < description.obstacles.size(); ++i) {
    const std::string field = fmt::format("world.obstacles[{}]", i);
    check(description.obstacles[i], description.units, field);
    check_widths(description.obstacles[i].shape, description.units, field + ".shape");
  }
  for (std::size_t i = 0; i < description.shapes.size(); ++i) {
    const std::string field = fmt::format("world.shapes[{}] ('{}')", i, description.shapes[i].name);
    const double rolling_friction = description.shapes[i].material.rolling_friction;
    check_shape(description.shapes[i], description.units, field);
    check_widths(description.shapes[i], description.units, field);
    require(rolling_friction == 0.0 || description.solver.small_steps(), field + ".material.rolling_friction",
            rolling_friction,
            R"(must be 0 with world.solver.kind = "engine": the engines' own solvers resist no rolling)");
  }
  check_masses(description.shapes);
  check_sides(description);
}

template <int Dim>
void check(const BodyDef<Dim>& body, const WorldDescription<Dim>& description) {
  const int shapes = static_cast<int>(description.shapes.size());
  if (body.shape < 0 || body.shape >= shapes)
    require(false, "body.shape", body.shape,
            fmt::format("must be the number of one of the {} shapes, counted from 0", shapes));
  check_pose(body.pose, description.units, "body.pose");
  for (int axis = 0; axis < Dim; ++axis)
    if (!std::isfinite(body.velocity[axis]))
      require(false, fmt::format("body.velocity[{}]", axis), body.velocity[axis], "must be finite");
  require(body.spin.allFinite(), "body.spin", body.spin.norm(), "must be finite");
  const double fastest = fastest_speed<Dim>(description.dt, description.units);
  if (body.velocity.norm() > fastest)
    require(false, "body.velocity", body.velocity.norm(),
            fmt::format("must be at most {:.6g} m/s: faster ones are slowed down or go through walls", fastest));
  const double most = fastest_spin(description.dt);
  if (body.spin.norm() > most)
    require(false, "body.spin", body.spin.norm(),
            fmt::format("must be at most {:.6g} rad/s, a quarter turn a step", most));
}

template void check(const Obstacle<2>&, const UnitScale&, const std::string&);
template void check(const Obstacle<3>&, const UnitScale&, const std::string&);
template void check(const WorldDescription<2>&);
template void check(const WorldDescription<3>&);
template void check_step(const WorldDescription<2>&, const UnitScale&);
template void check_step(const WorldDescription<3>&, const UnitScale&);
template void check_sides(const WorldDescription<2>&);
template void check_sides(const WorldDescription<3>&);
template void check(const BodyDef<2>&, const WorldDescription<2>&);
template void check(const BodyDef<3>&, const WorldDescription<3>&);

}  // namespace talus

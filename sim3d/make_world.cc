#include "sim3d/make_world.h"

#include <fmt/format.h>

#include <cmath>

#include "common/math/require.h"
#include "common/world/scaled_world.h"
#include "sim3d/engine_world.h"

namespace talus {
namespace {

/// What only Bullet in 3D cannot do. Of 64 cubes dropped in columns of four, 1 lay below the ground for good where a
/// step's fall was 0.1 of their side, 20 at 0.15, 45 at 0.2; in the plane at most 1 up to 0.6.
void check_for_bullet(const WorldDescription<3>& description) {
  constexpr double most_fall = 0.2;
  for (const Shape<3>& shape : description.shapes) {
    const double side = std::cbrt(shape.bounding_volume);
    const double most = most_fall * side / (description.dt * description.dt);
    require(description.gravity <= most, "world.gravity", description.gravity,
            fmt::format("must be at most {:.4g} m/s^2 at {:.6g} steps a second: Bullet presses bodies as small as "
                        "shape.{} into the ground",
                        most, 1.0 / description.dt, shape.name));
  }
}

// Memory and time: 4000 boxes of 1 m that land at once, in their first two seconds.
constexpr EngineTraits in_space = {
    .name = "bullet",
    .window = {.fewest_steps = 50.0, .fewest_iterations = 5, .largest_mass_ratio = 20.0, .longest_obstacle = 1000.0},
    .sinking_fall = 0.1,
    .awake_bytes = 8500.0,
    .sleeper_bytes = 1020.0,
    .awake_seconds = 7e-6};
constexpr EngineTraits in_the_plane = {
    .name = "bullet-planar",
    .window = {.fewest_steps = 40.0, .fewest_iterations = 5, .largest_mass_ratio = 20.0},
    .sinking_fall = 0.1,
    .awake_bytes = 6000.0,
    .sleeper_bytes = 1020.0,
    .awake_seconds = 4e-6};

}  // namespace

EngineTraits bullet_traits() { return in_space; }
EngineTraits bullet_planar_traits() { return in_the_plane; }

std::unique_ptr<World<3>> make_bullet_world(const WorldDescription<3>& description) {
  return make_in_engine_units<3>(description, [](const WorldDescription<3>& inner) {
    auto world = std::make_unique<bullet::EngineWorld<3>>(inner);  // checks what every engine demands
    check_for_bullet(inner);
    return world;
  });
}

std::unique_ptr<World<2>> make_bullet_planar_world(const WorldDescription<2>& description) {
  return make_in_engine_units<2>(
      description, [](const WorldDescription<2>& inner) { return std::make_unique<bullet::EngineWorld<2>>(inner); });
}

}  // namespace talus

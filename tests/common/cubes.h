#pragma once
// Cubes for tests of rules, in a world without physics.

#include <vector>

#include "common/shape/catalogue.h"
#include "tests/common/still_world.h"

namespace talus {

/// Cubes of 1 kg and 1 m: inertia m / 6 about each axis.
inline WorldDescription<3> cubes() {
  WorldDescription<3> world;
  world.gravity = 10.0;
  world.shapes.push_back(make_shape<3>("cube", box_pieces<3>(Vec3::Ones()), {.density = 1.0}));
  return world;
}

/// A still world with cubes at these places.
inline StillWorld<3> cubes_at(const std::vector<Vec3>& places) {
  StillWorld<3> world(cubes());
  for (const Vec3& place : places) world.add({.pose = {.position = place}});
  return world;
}

}  // namespace talus

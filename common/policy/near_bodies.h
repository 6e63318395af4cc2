#pragma once

#include <vector>

#include "common/world/world.h"

namespace talus {

/// How near to what left the world sleeping bodies wake, in extents: a body that rests on another one touches its box.
inline constexpr double waking_reach = 0.05;

/// All bodies, awake or asleep, whose box comes within `reach` [m] of `bounds`, ascending.
template <int Dim>
std::vector<BodyIndex> bodies_near(const World<Dim>& world, const Box<Dim>& bounds, double reach) {
  const Vec<Dim> margin = Vec<Dim>::Constant(reach);
  std::vector<BodyIndex> near;
  world.query_box({bounds.min() - margin, bounds.max() + margin}, near);
  return near;
}

}  // namespace talus

#pragma once
// Heaps of L shapes for the tests of this folder.

#include <random>

#include "common/shape/catalogue.h"
#include "sim2d/make_world.h"

namespace talus {

/// Ground and one shape, the L of the paper's first example.
inline WorldDescription<2> l_world() {
  WorldDescription<2> description;
  description.shapes = {make_shape<2>("L", l_pieces<2>({}), Material{})};
  return description;
}

/// Body number `index` of a loose stack, `columns` wide: random turns, room between all.
inline BodyDef<2> l_in_stack(int index, int columns, std::mt19937& random) {
  const double jitter = std::uniform_real_distribution<double>(-0.1, 0.1)(random);
  const double turn = std::uniform_real_distribution<double>(-3.0, 3.0)(random);
  const int row = index / columns;
  BodyDef<2> body;
  body.pose.position = {1.8 * (index % columns - (columns - 1) / 2.0) + jitter, 1.5 + 1.8 * row};
  body.pose.rotation = Rotation<2>(turn);
  return body;
}

inline void add_stack(World<2>& world, int count, int columns, unsigned seed = 1) {
  std::mt19937 random(seed);
  for (int i = 0; i < count; ++i) world.add(l_in_stack(i, columns, random));
}

inline void run(World<2>& world, int steps) {
  for (int i = 0; i < steps; ++i) world.step();
}

inline std::vector<BodyIndex> awake_of(const World<2>& world) { return {world.awake().begin(), world.awake().end()}; }

}  // namespace talus

#pragma once
// Heaps of L shapes for the tests of this folder.

#include <random>

#include "common/shape/catalogue.h"
#include "sim3d/make_world.h"

namespace talus {

/// Ground and one shape, the L of the paper's first example.
template <int Dim>
WorldDescription<Dim> l_world() {
  WorldDescription<Dim> description;
  description.shapes = {make_shape<Dim>("L", l_pieces<Dim>({}), Material{})};
  return description;
}

inline Eigen::Quaterniond random_turn(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::Vector4d q;
  for (int i = 0; i < 4; ++i) q[i] = normal(random);
  return Eigen::Quaterniond(q.normalized());
}

/// Body number `index` of a loose stack, `columns` wide in each direction: random turns, room between all.
inline BodyDef<3> l_in_stack(int index, int columns, std::mt19937& random) {
  const int level = index / (columns * columns);
  const int place = index % (columns * columns);
  BodyDef<3> body;
  body.pose.rotation = random_turn(random);
  body.pose.position = {1.6 * (place % columns), 1.6 * (place / columns), 1.5 + 1.6 * level};
  return body;
}

inline void add_stack(World<3>& world, int count, int columns, unsigned seed = 1) {
  std::mt19937 random(seed);
  for (int i = 0; i < count; ++i) world.add(l_in_stack(i, columns, random));
}

template <int Dim>
void run(World<Dim>& world, int steps) {
  for (int i = 0; i < steps; ++i) world.step();
}

template <int Dim>
std::vector<BodyIndex> awake_of(const World<Dim>& world) {
  return {world.awake().begin(), world.awake().end()};
}

}  // namespace talus

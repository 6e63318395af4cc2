#include "tools/bench/sleepers_cost.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "common/measure/ensemble.h"
#include "common/shape/catalogue.h"
#include "common/simulation/stopwatch.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

/// Memory that this process holds [bytes].
double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Place of body `index` in a block that is `side` bodies along each horizontal axis, a centimetre between any two.
template <int Dim>
Vec<Dim> place(int index, int side) {
  constexpr double spacing = 1.01;
  Vec<Dim> at;
  for (int axis = 0; axis + 1 < Dim; ++axis) {
    const int steps = index % side - side / 2;
    at[axis] = spacing * steps;
    index /= side;
  }
  at[Dim - 1] = 0.5 + spacing * index;
  return at;
}

template <int Dim>
double median_step(World<Dim>& world, int steps) {
  std::vector<double> seconds;
  Stopwatch watch;
  for (int step = 0; step < steps; ++step) {
    world.step();
    seconds.push_back(watch.lap());
  }
  return quantile(seconds, 0.5);
}

/// Adds and freezes batch by batch, so that never many are awake at once.
template <int Dim>
void add_block(World<Dim>& world, int sleepers, int side) {
  constexpr int batch = 500;
  std::vector<BodyIndex> block;
  for (int i = 0; i < sleepers; ++i) {
    block.push_back(world.add({.pose = {.position = place<Dim>(i, side)}}));
    if (static_cast<int>(block.size()) < batch && i + 1 < sleepers) continue;
    world.freeze(block);
    block.clear();
  }
}

/// A world of sleepers of one shape, side by side.
template <int Dim>
struct BlockOfSleepers {
  BlockOfSleepers(const std::string& backend, const std::vector<Piece<Dim>>& pieces, int sleepers, int side) {
    WorldDescription<Dim> description;
    Material material;
    material.friction = 0.8;
    description.shapes = {make_shape<Dim>("body", pieces, material)};
    malloc_trim(0);
    const double before = resident_bytes();
    world = make_world<Dim>(backend, description);
    add_block(*world, sleepers, side);
    median_step(*world, 1);
    bytes = (resident_bytes() - before) / sleepers;
  }

  std::unique_ptr<World<Dim>> world;
  double bytes = 0.0;  // a sleeper, everything included
};

template <int Dim>
std::vector<BodyIndex> add_top(World<Dim>& world, int sleepers, int side, int awake) {
  std::vector<BodyIndex> top;
  for (int i = 0; i < awake; ++i) {
    Vec<Dim> at = place<Dim>(i, side);
    at[Dim - 1] = place<Dim>(sleepers - 1, side)[Dim - 1] + 1.01;
    top.push_back(world.add({.pose = {.position = at}}));
  }
  return top;
}

/// Of one body, freezing and thawing together [us].
template <int Dim>
double freeze_thaw_time(World<Dim>& world, std::span<const BodyIndex> bodies) {
  constexpr int times = 50;
  Stopwatch watch;
  double seconds = 0.0;
  for (int i = 0; i < times; ++i) {
    watch.lap();
    world.freeze(bodies);
    world.thaw(bodies);
    seconds += watch.lap();
    world.step();
  }
  return 1e6 * seconds / times / static_cast<double>(bodies.size());
}

}  // namespace

template <int Dim>
SleepersCost sleepers_cost(const std::string& backend, int sleepers, int awake) {
  const int side = std::max(awake, static_cast<int>(std::pow(sleepers, 1.0 / Dim)));  // the awake find a flat top
  SleepersCost cost;
  cost.sleepers = sleepers;
  cost.bytes_of_l = BlockOfSleepers<Dim>(backend, l_pieces<Dim>(LParams{}), sleepers, side).bytes;
  const BlockOfSleepers<Dim> block(backend, box_pieces<Dim>(Vec<Dim>::Constant(1.0)), sleepers, side);
  World<Dim>& world = *block.world;
  cost.bytes = block.bytes;
  cost.idle_step_us = 1e6 * median_step(world, 200);
  const std::vector<BodyIndex> top = add_top(world, sleepers, side, awake);
  median_step(world, 60);
  cost.step_ms = 1e3 * median_step(world, 200);
  cost.freeze_thaw_us = freeze_thaw_time<Dim>(world, top);
  return cost;
}

template SleepersCost sleepers_cost<2>(const std::string&, int, int);
template SleepersCost sleepers_cost<3>(const std::string&, int, int);

}  // namespace talus

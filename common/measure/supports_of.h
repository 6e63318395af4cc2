#pragma once
// What one body lies on, whatever the engine reports.

#include <vector>

#include "common/scene/scene.h"
#include "common/world/world.h"

namespace talus {

/// What bodies may lie on beside one another.
struct FixedSupports {
  bool ground = false;
  double ground_height = 0.0;  // [m]
  int obstacles = 0;           // WorldDescription::obstacles
};

template <int Dim>
FixedSupports fixed_supports(const Scene<Dim>& scene) {
  return {.ground = scene.world.ground.present,
          .ground_height = scene.world.ground.height,
          .obstacles = static_cast<int>(scene.world.obstacles.size())};
}

/// Bodies, ground and obstacles (as in Contact) that touch `body` and that it would press into if it sank: found by
/// shapes and poses alone, so of sleeping bodies too, and without forces. Nearer than 3 % of the body's extent counts
/// as touching, above the gap that engines keep. Ascending.
template <int Dim>
std::vector<BodyIndex> supports_of(const World<Dim>& world, const FixedSupports& fixed, BodyIndex body);

}  // namespace talus

// A simulation with an engine of the program's own, which takes nothing of talus but talus::core.
#include <fmt/format.h>

#include "toy_engine.h"

int main() {
  talus::Scene<3> scene;
  scene.world.shapes = {talus::make_shape<3>("ball", talus::ball_pieces<3>(0.5), {})};
  scene.sources = {{.count = 20, .position = {0.0, 0.0, 5.0}, .spread = {9.0, 9.0, 0.0}}};
  scene.piles = {{}};
  talus::Simulation<3> simulation(scene, talus::make_toy_world(scene.world), talus::make_policy(scene));
  while (simulation.time() < 10.0) simulation.step();
  fmt::print("{} bodies, {} awake\n", simulation.world().states().size(), simulation.world().awake().size());
}

// A pile in a program of one's own: the example of README.md.
#include <fmt/format.h>
#include <talus/box2d_world.h>
#include <talus/simulation.h>

int main() {
  talus::Scene<2> scene;
  scene.world.shapes = {talus::make_shape<2>("L", talus::l_pieces<2>({}), {.friction = 0.6})};
  scene.sources = {{.count = 100, .position = {0.0, 15.0}, .velocity = {0.0, -10.0}}};
  scene.piles = {{}};
  talus::Simulation<2> simulation(scene, talus::make_box2d_world(scene.world), talus::make_policy(scene));
  while (simulation.time() < 30.0) simulation.step();
  fmt::print("{} bodies, {} awake\n", simulation.world().states().size(), simulation.world().awake().size());
}

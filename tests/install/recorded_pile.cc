// A scene file run on Bullet and recorded: recorded_pile SCENE RECORD.
#include <fmt/format.h>
#include <talus/bullet_world.h>
#include <talus/scene.h>
#include <talus/simulation.h>
#include <talus/telemetry.h>
#include <talus/version.h>

int main(int, char** arguments) {
  const auto scene = std::get<talus::Scene<3>>(talus::read_scene(arguments[1]));
  talus::RunRecorder<3> recorder(arguments[2], talus::run_info(scene, "pile", "bullet"), scene);
  talus::Simulation<3> simulation(scene, talus::make_bullet_world(scene.world), talus::make_policy(scene));
  simulation.add_observer(recorder);
  while (!simulation.finished()) simulation.step();
  simulation.end("finished");
  fmt::print("talus {}: {} bodies\n", TALUS_VERSION, simulation.world().states().size());
}

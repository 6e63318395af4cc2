// What the tests of the live view start: a run of a small pile with record and telemetry, the monitor, and a look into
// a log.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <map>
#include <string>
#include <thread>

#include "common/shape/catalogue.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "common/simulation/state_hash.h"
#include "lcmtypes/log_reader.h"
#include "lcmtypes/publisher.h"
#include "lcmtypes/run_recorder.h"
#include "sim2d/make_world.h"
#include "tools/monitor/monitor_command.h"

namespace talus {
namespace {

struct Options {
  std::string url;
  std::string record;
  int frames = 90;
  bool paced = false;   // as fast as real time
  bool silent = false;  // without telemetry
};

Scene<2> small_pile(const Options& options) {
  Scene<2> scene;
  scene.world.shapes = {make_shape<2>("l", l_pieces<2>({}), {})};
  scene.sources.resize(1);
  scene.sources[0].count = 60;
  scene.sources[0].rate = 40.0;
  scene.sources[0].position = Vec2(0.0, 4.0);
  scene.sources[0].spread = Vec2(4.0, 2.0);
  scene.piles.emplace_back().at = Vec2::Zero();
  scene.run.frames = options.frames;
  return scene;
}

/// Prints the hash of the last state.
void run(const Options& options) {
  const Scene<2> scene = small_pile(options);
  const RunInfo info = run_info(scene, "small_pile", "box2d");
  RunRecorder<2> recorder(options.record, info, scene, {.flush_interval = 0.1});
  Simulation<2> simulation(scene, make_box2d_world(scene.world), make_policy<2>(scene));
  simulation.add_observer(recorder);
  std::unique_ptr<Publisher<2>> publisher;
  if (!options.silent) {
    publisher = std::make_unique<Publisher<2>>(info, scene, PublisherParams{.url = options.url, .piles_rate = 0.0});
    simulation.add_observer(*publisher);
  }
  const auto begin = std::chrono::steady_clock::now();
  for (std::int64_t step = 0; step < scene.steps(); ++step) {
    simulation.step();
    if (options.paced) std::this_thread::sleep_until(begin + std::chrono::duration<double>(simulation.time()));
  }
  simulation.end("finished");
  fmt::print("{:016x}\n", state_hash(simulation.world().states()));
}

/// Prints how many events a log has on each channel, and the bytes that are damaged.
void count(const std::string& path) {
  LogReader reader(path);
  std::map<std::string, int> events;
  for (LogEvent event; reader.next(event);) ++events[event.channel];
  for (const auto& [channel, number] : events) fmt::print("{} {}\n", channel, number);
  fmt::print("damaged {}\n", reader.damage().bytes);
}

}  // namespace
}  // namespace talus

int main(int argc, char** argv) {
  CLI::App app;
  talus::add_monitor_command(app);
  talus::Options options;
  CLI::App* run = app.add_subcommand("run");
  run->add_option("--lcm-url", options.url);
  run->add_option("--record", options.record)->required();
  run->add_option("--frames", options.frames);
  run->add_flag("--paced", options.paced);
  run->add_flag("--silent", options.silent);
  run->callback([&] { talus::run(options); });
  std::string log;
  CLI::App* count = app.add_subcommand("count");
  count->add_option("log", log)->required();
  count->callback([&] { talus::count(log); });
  CLI11_PARSE(app, argc, argv);
}

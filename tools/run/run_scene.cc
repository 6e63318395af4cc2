#include "tools/run/run_scene.h"

#include <fmt/format.h>

#include "common/scene/engine_warnings.h"
#include "common/scene/read_scene.h"
#include "common/scene/warnings.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/state_hash.h"
#include "common/simulation/stopwatch.h"
#include "common/text/printable.h"
#include "common/world/errors.h"
#include "tools/commands/commands.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"
#include "tools/run/interrupt.h"
#include "tools/run/make_simulation.h"
#include "tools/run/run_outputs.h"
#include "tools/run/tell_run.h"

namespace talus {

namespace {

/// The command line's wishes as overrides of the scene file, so that they are checked and recorded like its own values.
std::vector<Override> overrides(const RunOptions& options, const std::string& policy) {
  std::vector<Override> list;
  for (const std::string& setting : options.settings) list.push_back({setting});
  if (!policy.empty()) list.push_back({"policy.kind=" + policy});
  if (options.seed) list.push_back({fmt::format("seed={}", *options.seed)});
  return list;
}

/// Steps to the end of the scene, to Ctrl-C or to a failure, and says which.
template <int Dim>
std::string advance(Simulation<Dim>& simulation, std::int64_t steps, const Interrupt& interrupt) {
  try {
    for (std::int64_t i = 0; i < steps; ++i) {
      if (interrupt.asked()) return "interrupted";
      simulation.step();
    }
  } catch (const NonFiniteState& error) {
    return error.what();
  }
  return "finished";
}

int exit_code_of(std::string_view reason) {
  if (reason == "finished") return exit_codes::success;
  return reason == "interrupted" ? exit_codes::interrupted : exit_codes::failed;
}

template <int Dim>
void warn(const Scene<Dim>& scene, const std::string& backend) {
  for (const std::string& warning : warnings(scene)) fmt::print(stderr, "warning: {}\n", printable(warning));
  for (const std::string& warning : engine_warnings(scene, engine_traits<Dim>(backend)))
    fmt::print(stderr, "warning: {}: {}\n", backend, printable(warning));
}

template <int Dim>
int print_hash(const Scene<Dim>& scene, const std::string& backend) {
  const Interrupt interrupt;
  Simulation<Dim> simulation = make_simulation(scene, backend);
  const std::string reason = advance(simulation, scene.steps(), interrupt);
  fmt::print("{:016x}\n", state_hash(simulation.world().states()));
  return exit_code_of(reason);
}

/// Mean time of a step [ms] of the same scene under another policy, with nothing recorded.
template <int Dim>
double step_ms_of(const Scene<Dim>& scene, const std::string& backend, const Interrupt& interrupt) {
  Simulation<Dim> simulation = make_simulation(scene, backend);
  Stopwatch watch;
  advance(simulation, scene.steps(), interrupt);
  return 1e3 * watch.lap() / static_cast<double>(scene.steps());
}

template <int Dim>
int run(const RunOptions& options, const std::string& name, const Scene<Dim>& scene) {
  const std::vector<std::string> engines = backends(Dim);
  const std::string backend = options.backend.empty() && !engines.empty() ? engines.front() : options.backend;
  if (!options.hash_only) warn(scene, backend);
  if (options.hash_only && options.out.empty()) return print_hash(scene, backend);

  Simulation<Dim> simulation = make_simulation(scene, backend);
  RunOutputs<Dim> outputs(options, scene, name, backend, simulation);
  const Interrupt interrupt;
  Stopwatch watch;
  const std::string reason = advance(simulation, scene.steps(), interrupt);
  const SummaryInput summary{name, backend, reason, watch.lap(), simulation.emitter().waits()};
  simulation.end(reason);
  outputs.finish(summary, scene, simulation);
  if (options.hash_only) {
    fmt::print("{:016x}\n", state_hash(simulation.world().states()));
    return exit_code_of(reason);
  }
  tell_run(summary, scene, simulation, outputs);
  if (!options.against.empty() && reason == "finished") {
    const auto other = read_scene(find_scene(options.scene), overrides(options, options.against));
    tell_speed_up(options.against, step_ms_of(std::get<Scene<Dim>>(other), backend, interrupt),
                  outputs.statistics().mean_step_ms());
  }
  return exit_code_of(reason);
}

}  // namespace

int run_scene(const RunOptions& options) {
  const std::filesystem::path file = find_scene(options.scene);
  const auto scene = read_scene(file, overrides(options, options.policy));
  return std::visit([&](const auto& of_dimension) { return run(options, file.stem().string(), of_dimension); }, scene);
}

}  // namespace talus

#include "tools/run/run_scene.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <optional>
#include <thread>

#include "common/scene/happened.h"
#include "common/scene/read_scene.h"
#include "common/scene/warnings.h"
#include "common/simulation/make_policy.h"
#include "common/simulation/state_hash.h"
#include "common/text/printable.h"
#include "common/world/stopwatch.h"
#include "common/world/world.h"
#ifdef TALUS_LCM
#include "lcmtypes/live_link.h"
#endif
#include "tools/output/interrupt.h"
#include "tools/output/output.h"
#include "tools/run/backends.h"
#include "tools/run/find_scene.h"
#include "tools/run/finish_run.h"
#include "tools/run/make_simulation.h"
#include "tools/run/measured_drift.h"
#include "tools/run/progress.h"
#include "tools/run/run_outputs.h"
#include "tools/run/speed_up.h"

namespace talus {
namespace {

/// With those of `run` that have an option.
std::vector<Override> with_run(const RunOptions& options, std::vector<Override> list) {
  if (options.pace)
    list.push_back({fmt::format("run.pace={}", *options.pace), fmt::format("--pace {}", *options.pace)});
  if (options.threads)
    list.push_back({fmt::format("run.threads={}", *options.threads), fmt::format("--threads {}", *options.threads)});
  return list;
}

/// Steps to the end of the run, to Ctrl-C or to a failure; returns which. With a pace waits after each step for the
/// time at which it is to be done.
template <int Dim>
std::string advance(Simulation<Dim>& simulation, const Interrupt& interrupt, double pace) {
  const auto start = std::chrono::steady_clock::now();
  try {
    while (!simulation.finished()) {
      if (interrupt.requested()) return "interrupted";
      simulation.step();
      if (pace > 0.0) std::this_thread::sleep_until(start + std::chrono::duration<double>(simulation.time() / pace));
    }
  } catch (const NonFiniteState& error) {
    return error.what();
  }
  return "finished";
}

/// `warned`: whether there was a warning, and it counts.
int exit_code_of(std::string_view reason, bool warned) {
  if (reason == "finished") return warned ? exit_codes::failed : exit_codes::success;
  return reason == "interrupted" ? exit_codes::interrupted : exit_codes::failed;
}

/// A run that did not finish has no end: its reason instead of a hash.
template <int Dim>
int print_hash(const Simulation<Dim>& simulation, const std::string& reason, bool warned) {
  if (reason == "finished")
    print_result("{:016x}\n", state_hash(simulation.world().states()));
  else
    print_message("talus: no end hash: {}", reason);
  return exit_code_of(reason, warned);
}

/// Only with --strict are there observers, which cost time, and so warnings.
template <int Dim>
int hash_run(const RunOptions& options, const Scene<Dim>& scene, const std::string& backend, bool warned) {
  const Interrupt interrupt;
  Simulation<Dim> simulation = make_simulation(scene, backend);
  WarningPrinter<Dim> printer;
  RunStatistics<Dim> statistics;
  if (options.strict) {
    simulation.add_observer(printer);
    simulation.add_observer(statistics);
  }
  const std::string reason = advance(simulation, interrupt, scene.run.pace);
  SummaryInput summary{.scene_name = {}, .backend = backend, .reason = reason};
  if (options.strict)
    finish_run<Dim>(
        options, scene, simulation, statistics, [&interrupt] { return interrupt.requested(); }, summary);
  warned = warned || !summary.scene_warnings.empty() || !summary.warnings.empty();
  return print_hash(simulation, reason, options.strict && warned);
}

/// Runs, records and prints the result.
template <int Dim>
int record_run(const RunOptions& options, const std::string& name, const std::string& backend, const Scene<Dim>& scene,
               const std::vector<SceneError>& outside, const std::vector<std::string>& scene_warnings) {
  Simulation<Dim> simulation = make_simulation(scene, backend);
  RunOutputs<Dim> outputs(options, scene, name, backend, simulation);
  const Interrupt interrupt;
  Stopwatch watch;
  const std::string reason = advance(simulation, interrupt, scene.run.pace);
  SummaryInput summary{.scene_name = name,
                       .backend = backend,
                       .reason = reason,
                       .wall_seconds = watch.lap(),
                       .emit_waits = simulation.emitter().waits(),
                       .outside_window = outside,
                       .scene_warnings = scene_warnings};
  finish_run<Dim>(
      options, scene, simulation, outputs.statistics(), [&interrupt] { return interrupt.requested(); }, summary);
  for (std::string& line : idle_event_lines(scene, simulation.done_events()))
    summary.scene_warnings.push_back(std::move(line));
  std::exception_ptr unwritten;  // known only when hours are over, so the run's lines come first
  try {
    outputs.finish(summary, scene, simulation);
  } catch (const std::exception&) {
    unwritten = std::current_exception();
  }
  const bool warned = !outside.empty() || !summary.scene_warnings.empty() || !summary.warnings.empty();
  int exit_code = exit_code_of(reason, options.strict && warned);
  if (options.hash_only)
    exit_code = print_hash(simulation, reason, options.strict && warned);
  else
    print_run(summary, scene, simulation, outputs);
  if (unwritten) std::rethrow_exception(unwritten);
  return exit_code;
}

#ifdef TALUS_LCM
void check_live_url(const std::string& url) {
  check_url(url);
  require_local(effective_url(url));
}
#endif

}  // namespace

std::vector<Override> overrides_of(const SceneChoice& choice) {
  std::vector<Override> list;
  for (const std::string& setting : choice.settings) list.push_back({setting});
  if (!choice.policy.empty()) list.push_back({"policy.kind=" + choice.policy, "--policy " + choice.policy});
  if (!choice.accuracy.empty()) list.push_back({"accuracy=" + choice.accuracy, "--accuracy " + choice.accuracy});
  if (choice.seed) list.push_back({fmt::format("seed={}", *choice.seed), fmt::format("--seed {}", *choice.seed)});
  return list;
}

int run_scene(const RunOptions& options) {
#ifdef TALUS_LCM
  if (options.telemetry) check_live_url(options.lcm_url);
#endif
  const std::filesystem::path file = find_scene(options.scene);
  const AnyScene scene = read_scene(file, with_run(options, overrides_of(options)));
  // Read before the run, so that a policy that does not exist is refused before it.
  std::optional<AnyScene> other;
  if (!options.against.empty()) {
    std::vector<Override> list = with_run(options, overrides_of(options));
    list.push_back({"policy.kind=" + options.against, "--against " + options.against});
    other = read_scene(file, list);
  }
  return std::visit(
      [&]<int Dim>(const Scene<Dim>& of_dimension) {
        const std::string backend = backend_for(options.backend, Dim);
        const std::vector<SceneError> outside = check_window(of_dimension, backend, file, options.force);
        if (other) check_window(std::get<Scene<Dim>>(*other), backend, file, options.force);
        if (options.measure_drift) require_measurable_drift(of_dimension);
        const std::vector<std::string> of_scene = scene_warnings(of_dimension, backend);
        if (!options.hash_only || options.strict) print_scene_warnings(outside, of_scene);
        if (options.hash_only && options.out.empty())
          return hash_run(options, of_dimension, backend, !outside.empty() || !of_scene.empty());
        const int exit_code = record_run(options, file.stem().string(), backend, of_dimension, outside, of_scene);
        if (!other || exit_code != exit_codes::success) return exit_code;
        return tell_speed_up(of_dimension, std::get<Scene<Dim>>(*other), backend);
      },
      scene);
}

}  // namespace talus

#include "tools/run/run_outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "common/scene/accuracy.h"
#include "common/scene/happened.h"
#include "common/scene/write_scene.h"
#include "common/simulation/state_hash.h"
#include "common/text/printable.h"
#include "tools/output/output.h"
#include "tools/picture/terminal.h"
#include "tools/run/frames_csv.h"
#include "tools/run/make_simulation.h"
#include "tools/run/progress.h"
#include "tools/run/run_files.h"
#include "tools/run/version.h"
#ifdef TALUS_LCM
#include "lcmtypes/publisher.h"
#include "lcmtypes/run_recorder.h"
#endif

namespace talus {

namespace {

/// Obstacles that are still there.
template <int Dim>
std::vector<Obstacle<Dim>> present_obstacles(const Scene<Dim>& scene, const World<Dim>& world, double time) {
  std::vector<Obstacle<Dim>> present;
  const std::vector<Obstacle<Dim>> all = obstacles_at(scene.world.obstacles, scene.movers, time);
  for (int k = 0; k < std::ssize(all); ++k)
    if (world.has_obstacle(k)) present.push_back(all[k]);
  return present;
}

template <int Dim>
PictureInput<Dim> picture_of(const std::string& backend, const Scene<Dim>& scene, const Frame<Dim>& frame) {
  const World<Dim>& world = frame.world;
  const auto bodies = world.states().shape.size();
  return {.shapes = scene.world.shapes,
          .states = world.states(),
          .piles = frame.piles.piles(),
          .obstacles = present_obstacles(scene, world, frame.time),
          .ground = scene.world.ground,
          .title = printable(scene.title),
          .caption = fmt::format("{}, policy {}, seed {}, after {:.4g} s: {} bodies, {} asleep",
                                 solved_by(backend, scene.world.solver.kind),
                                 policy_at(scene, frame.done_events, frame.time).kind, scene.seed, frame.time, bodies,
                                 bodies_asleep(world)),
          .sides = scene.world.periodic()};
}

/// Draws the pictures of events, and prints a line for each event.
template <int Dim>
class EventWatch final : public Observer<Dim> {
 public:
  EventWatch(const Scene<Dim>& scene, std::string backend, std::filesystem::path folder,
             const ContactForces<Dim>& contacts, bool prints)
      : scene_(scene), backend_(std::move(backend)), folder_(std::move(folder)), contacts_(contacts), prints_(prints) {}

  void on_frame(const Frame<Dim>& frame) override {
    for (const DoneEvent& event : frame.done_events.last(frame.done_now)) {
      const EventAction action = scene_.events[event.number].action;
      if (prints_)
        print_message("event {} at {:.4g} s: {}", event.number, event.time, printable(event_text(scene_, event)));
      if (action != EventAction::picture) continue;
      const std::string name = fmt::format("event_{}", event.number);
      PictureInput<Dim> picture = picture_of(backend_, scene_, frame);
      picture.contacts = contacts_.of(frame.world);
      draw_pile(folder_ / (name + ".svg"), folder_ / (name + ".png"), picture);
    }
  }

 private:
  const Scene<Dim>& scene_;
  std::string backend_;
  std::filesystem::path folder_;
  const ContactForces<Dim>& contacts_;
  bool prints_;
};

}  // namespace

template <int Dim>
PictureInput<Dim> picture_input(const SummaryInput& summary, const Scene<Dim>& scene,
                                const Simulation<Dim>& simulation) {
  return picture_of(summary.backend, scene, simulation.frame());
}

template <int Dim>
RunOutputs<Dim>::RunOutputs(const RunOptions& options, const Scene<Dim>& scene, const std::string& scene_name,
                            const std::string& backend, Simulation<Dim>& simulation)
    : folder_(make_run_folder(options.out, fmt::format("{}-{}-{}", scene_name, backend, scene.policy.kind))),
      instruments_(scene, folder_) {
  write_scene_files(scene_files(scene), folder_);
  simulation.add_observer(statistics_);
  if (!scene.instruments.empty()) simulation.add_observer(instruments_);
  contacts_.record(scene.run.contacts, simulation.world());
  if (scene.run.contacts) simulation.add_observer(contacts_);
  add(std::make_unique<FramesCsv<Dim>>(folder_ / run_files::frames), simulation);
#ifdef TALUS_LCM
  RunInfo info = run_info(scene, scene_name, backend);
  info.version = version_text();
  auto recorder = std::make_unique<RunRecorder<Dim>>((folder_ / run_files::record).string(), info, scene);
  recorder->set_instruments(instruments_.meters());
  recorder->set_contacts(contacts_);
  add(std::move(recorder), simulation);
  if (options.telemetry) {
    const PublisherParams params{
        .url = options.lcm_url, .piles_rate = options.telemetry_hz, .bodies_rate = options.bodies_hz};
    auto publisher = std::make_unique<Publisher<Dim>>(info, params);
    publisher->set_world(scene.world);
    publisher->set_scene(scene);
    publisher->set_instruments(instruments_.meters());
    publisher->set_contacts(contacts_);
    add(std::move(publisher), simulation);
  }
#endif
  if (!scene.events.empty())
    add(std::make_unique<EventWatch<Dim>>(scene, backend, folder_, contacts_, !options.hash_only), simulation);
  if (!options.quiet) add(std::make_unique<WarningPrinter<Dim>>(), simulation);
  if (!options.hash_only) add(std::make_unique<Progress<Dim>>(scene.steps()), simulation);
}

template <int Dim>
void RunOutputs<Dim>::add(std::unique_ptr<Observer<Dim>> observer, Simulation<Dim>& simulation) {
  simulation.add_observer(*observer);
  observers_.push_back(std::move(observer));
}

template <int Dim>
void RunOutputs<Dim>::finish(const SummaryInput& summary, const Scene<Dim>& scene, Simulation<Dim>& simulation) const {
  const auto write = [&](const SummaryInput& input) {
    write_summary(folder_ / run_files::summary, input, scene, simulation, statistics_, instruments_);
  };
  SummaryInput with_picture = summary;
  write(with_picture);  // a disk that is full by the pictures leaves the numbers
  PictureInput<Dim> picture = picture_input(summary, scene, simulation);
  picture.contacts = contacts_.of(simulation.world());
  with_picture.pixels_per_metre = draw_pile(folder_ / run_files::drawing, folder_ / run_files::picture, picture);
  write(with_picture);
}

template PictureInput<2> picture_input(const SummaryInput&, const Scene<2>&, const Simulation<2>&);
template PictureInput<3> picture_input(const SummaryInput&, const Scene<3>&, const Simulation<3>&);
template class RunOutputs<2>;
template class RunOutputs<3>;

/// What is known of the error that sleep has caused.
template <int Dim>
void print_estimate(const Simulation<Dim>& simulation, const std::optional<DriftProbe>& probe,
                    const AdaptiveParams& params) {
  const auto& asleep = simulation.world().states().asleep;
  const bool any_asleep = std::ranges::any_of(asleep, [](std::uint8_t is_asleep) { return is_asleep != 0; });
  if (params.tolerance <= 0.0 || !any_asleep) return;
  const std::optional<ToldDrift> drift = told_drift(simulation.frame());
  if (probe) {
    print_result(
        "  once woken, the sleeping bodies would move by some {:.2g} D on average ({:.2g} to {:.2g}; {:.2g} s "
        "simulated), "
        "tolerance {:g} D\n",
        drift->drift, probe->least, probe->most, probe->seconds, params.tolerance);
    return;
  }
  if (const auto awake = simulation.world().awake().size(); !drift && awake > 0) {
    print_result("  not at rest, {} awake: the error of the sleeping bodies is not known\n", awake);
    return;
  }
  if (!drift) {
    print_result("  the error of the sleeping bodies is not known\n");
    return;
  }
  print_result("  once woken, the sleeping bodies would move by some {:.2g} D ({:.0f} % of them checked)\n",
               drift->drift, 100.0 * drift->checked_share);
}

/// `tolerance` [D], 0: none.
void print_measured(const MeasuredDrift& drift, double tolerance) {
  if (!drift.missing.empty()) {
    print_result("  drift not measured: {}\n", drift.missing);
    return;
  }
  print_result(
      "  measured: the {} sleeping bodies move by {:.2g} D on average, 95 % by at most {:.2g} D, the farthest by "
      "{:.2g} D{}\n",
      drift.bodies, drift.mean, drift.p95, drift.max,
      tolerance > 0.0 ? fmt::format("; tolerance {:g} D", tolerance) : "");
}

template <int Dim>
void print_run(const SummaryInput& summary, const Scene<Dim>& scene, Simulation<Dim>& simulation,
               const RunOutputs<Dim>& outputs) {
  const RunStatistics<Dim>& statistics = outputs.statistics();
  const World<Dim>& world = simulation.world();
  const auto bodies = world.states().shape.size();
  print_result("{}: {}, {} on {}, policy {}\n", printable(summary.scene_name), printable(summary.reason),
               printable(scene.title), solved_by(summary.backend, scene.world.solver.kind), scene.policy.kind);
  print_result(
      "  {} bodies, {} asleep at the end; over {} steps {:.1f} awake in the mean, {:.1f} % of body-steps skipped\n",
      bodies, bodies_asleep(world), statistics.steps(), statistics.mean_awake(), 100.0 * statistics.work_skipped());
  print_result("  {}\n", accuracy_text(scene));
  print_result("  {:.3f} ms a step ({:.3f} over the last 100), {:.2f} s in all, {:.1f} times real time\n",
               statistics.mean_step_ms(), statistics.last_step_ms(), summary.wall_seconds,
               simulation.time() / summary.wall_seconds);
  const PolicyParams policy = policy_at(scene, simulation.done_events(), simulation.time());
  if (policy.tolerance()) print_estimate(simulation, summary.probe, policy.adaptive);
  if (summary.measured) print_measured(*summary.measured, policy.tolerance().value_or(0.0));
  if (const RunOverlap overlap = simulation.frame().overlap; overlap.deepest > 0.0)
    print_result("  contacts overlap by at most {:.2g} D, {:.2g} % of them by more than {:g} D\n", overlap.deepest,
                 100.0 * overlap.share, overlap_limit);
  for (const std::string& line : outputs.instruments().lines()) print_result("  {}\n", line);
  if (simulation.at_rest()) print_result("  at rest after {:.4g} s\n", simulation.time());
  for (const SceneError& each : summary.outside_window)
    print_result("  warning: {}{}\n", outside_prefix, printable(to_string(each)));
  for (const Warning& warning : summary.warnings) print_result("  warning: {}\n", account(warning));
  for (const std::string& line : idle_event_lines(scene, simulation.done_events()))
    print_result("  warning: {}\n", printable(line));
  if (const Emitter<Dim>& emitter = simulation.emitter(); emitter.emitted() < emitter.total())
    print_result("  {} of {} bodies appeared before the end\n", emitter.emitted(), emitter.total());
  if (summary.emit_waits > 0) {
    print_result("  the sources waited {} for a free place; `talus check` gives the rate that they can reach\n",
                 summary.emit_waits == 1 ? "once" : fmt::format("{} times", summary.emit_waits));
  }
  print_result("  end hash {:016x}\n  {}/pile.png shows the pile, summary.json has the numbers\n",
               state_hash(world.states()), printable(outputs.folder().string()));
  if (isatty(STDOUT_FILENO) == 0) return;
  constexpr int widest = 100;    // wider ones only magnify
  constexpr int narrowest = 48;  // narrower ones show nothing
  const int width = terminal_width(STDOUT_FILENO);
  if (width < narrowest) return;
  const TerminalParams params{.columns = std::min(width, widest), .colours = std::getenv("NO_COLOR") == nullptr};
  print_text(terminal_picture(picture_input(summary, scene, simulation), params));
}

template void print_run(const SummaryInput&, const Scene<2>&, Simulation<2>&, const RunOutputs<2>&);
template void print_run(const SummaryInput&, const Scene<3>&, Simulation<3>&, const RunOutputs<3>&);

}  // namespace talus

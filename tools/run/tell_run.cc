#include "tools/run/tell_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "common/simulation/state_hash.h"
#include "common/text/printable.h"
#include "tools/picture/terminal.h"
#include "tools/run/terminal_width.h"

namespace talus {

template <int Dim>
void tell_run(const SummaryInput& summary, const Scene<Dim>& scene, Simulation<Dim>& simulation,
              const RunOutputs<Dim>& outputs) {
  const RunStatistics<Dim>& statistics = outputs.statistics();
  const World<Dim>& world = simulation.world();
  const auto bodies = world.states().shape.size();
  fmt::print("{}: {}, {} on {}, policy {}\n", printable(summary.scene_name), printable(summary.reason),
             printable(scene.title), summary.backend, scene.policy.kind);
  fmt::print(
      "  {} bodies, {} asleep at the end; over {} steps {:.1f} awake in the mean, {:.1f} % of body-steps skipped\n",
      bodies, bodies - world.awake().size(), statistics.steps(), statistics.mean_awake(),
      100.0 * statistics.work_skipped());
  fmt::print("  {:.3f} ms a step ({:.3f} over the last 100), {:.2f} s in all, {:.1f} times real time\n",
             statistics.mean_step_ms(), statistics.last_step_ms(), summary.wall_seconds,
             simulation.time() / summary.wall_seconds);
  if (summary.emit_waits > 0) {
    fmt::print("  the sources waited {} times for a free place; `talus check` tells what rate they can reach\n",
               summary.emit_waits);
  }
  fmt::print("  end hash {:016x}\n  {}/pile.png shows the pile, summary.json has the numbers\n",
             state_hash(world.states()), printable(outputs.folder().string()));
  if (isatty(STDOUT_FILENO) == 0) return;
  constexpr int widest = 100;    // wider ones only magnify
  constexpr int narrowest = 48;  // narrower ones show nothing
  const int width = terminal_width(STDOUT_FILENO);
  if (width < narrowest) return;
  const TerminalParams params{.columns = std::min(width, widest), .colours = std::getenv("NO_COLOR") == nullptr};
  fmt::print("{}", terminal_picture(picture_input(summary, scene, simulation), params));
}

void tell_speed_up(const std::string& other_policy, double other_ms, double own_ms) {
  fmt::print("  {:.2f} times as fast as policy {} ({:.3f} ms a step), both without recording\n", other_ms / own_ms,
             other_policy, other_ms);
}

template void tell_run(const SummaryInput&, const Scene<2>&, Simulation<2>&, const RunOutputs<2>&);
template void tell_run(const SummaryInput&, const Scene<3>&, Simulation<3>&, const RunOutputs<3>&);

}  // namespace talus

#include "tools/run/print_run.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "common/simulation/state_hash.h"
#include "common/text/printable.h"
#include "tools/output/output.h"
#include "tools/picture/terminal.h"
#include "tools/run/terminal_width.h"

namespace talus {

template <int Dim>
void print_run(const SummaryInput& summary, const Scene<Dim>& scene, Simulation<Dim>& simulation,
               const RunOutputs<Dim>& outputs) {
  const RunStatistics<Dim>& statistics = outputs.statistics();
  const World<Dim>& world = simulation.world();
  const auto bodies = world.states().shape.size();
  print_result("{}: {}, {} on {}, policy {}\n", printable(summary.scene_name), printable(summary.reason),
               printable(scene.title), summary.backend, scene.policy.kind);
  print_result(
      "  {} bodies, {} asleep at the end; over {} steps {:.1f} awake in the mean, {:.1f} % of body-steps skipped\n",
      bodies, bodies - world.awake().size(), statistics.steps(), statistics.mean_awake(),
      100.0 * statistics.work_skipped());
  print_result("  {:.3f} ms a step ({:.3f} over the last 100), {:.2f} s in all, {:.1f} times real time\n",
               statistics.mean_step_ms(), statistics.last_step_ms(), summary.wall_seconds,
               simulation.time() / summary.wall_seconds);
  for (const Warning& warning : simulation.warnings()) print_result("  warning: {}\n", account(warning));
  if (const Emitter<Dim>& emitter = simulation.emitter(); emitter.emitted() < emitter.total()) {
    print_result("  {} of {} bodies appeared before the end\n", emitter.emitted(), emitter.total());
  }
  if (summary.emit_waits > 0) {
    print_result("  the sources waited {} times for a free place; `talus check` gives the rate that they can reach\n",
                 summary.emit_waits);
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

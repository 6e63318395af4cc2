#include "tools/commands/commands.h"
#include "tools/commands/scene_options.h"
#include "tools/commands/validators.h"
#include "tools/run/run_options.h"
#include "tools/run/run_scene.h"

namespace talus {
namespace {

constexpr const char* footer =
    "Examples:\n"
    "  talus run drop_in_a_pile_2d\n"
    "  talus run scenes/drop_in_a_pile_3d.toml --policy full --out runs/reference\n"
    "  talus run drop_in_a_pile_2d --backend bullet-planar --set policy.tau=0.3 --set pile[0].alpha_deg=25\n\n"
    "Exit code: 0 done, 1 the run failed (with --strict: or there was a warning), 2 bad input, 130 interrupted "
    "(everything up to then is saved).";

/// What the run leaves, sends and prints.
void add_output_options(CLI::App& command, RunOptions& options) {
  command.add_option("-o,--out", options.out, "Run folder, new or empty; without it a new one under runs/")
      ->check(not_empty());
  auto* url = command
                  .add_option("--lcm-url", options.lcm_url,
                              "Where to publish; default: LCM_DEFAULT_URL, else this machine only")
                  ->check(not_empty());
  command.add_option("--telemetry-hz", options.telemetry_hz, "Pile messages a second of wall time; 0: one a step")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
  command.add_option("--bodies-hz", options.bodies_hz, "Poses of the awake bodies a second of wall time; 0: none")
      ->check(number_between(0.0, 1e3))
      ->capture_default_str();
  command.add_flag("!--no-telemetry", options.telemetry, "Publish nothing over LCM")->excludes(url);
  auto* against =
      command
          .add_option("--against", options.against,
                      "Afterwards time the scene under this policy and under --policy, several rounds in turn; print "
                      "how many times faster the run is: median and range")
          ->check(not_empty());
  command.add_flag("--strict", options.strict,
                   "Exit with 1 when a body was lost or the scene or run gave any other warning");
  auto* measure = command.add_flag(
      "--measure-drift", options.measure_drift,
      "At the end wake all bodies in a copy of the world and measure how far the sleeping ones move; warn above the "
      "tolerance");
  command.add_flag(
      "!--no-drift-probe", options.probe_drift,
      "Do not estimate by a short simulation at the end how far the sleeping bodies would move once woken");
  command.add_flag("--hash", options.hash_only, "Print the end hash and nothing else; no folder unless --out")
      ->excludes(against)
      ->excludes(measure);
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("run", "Simulate a scene and leave a run folder");
  command->footer(footer);
  auto options = std::make_shared<RunOptions>();
  add_scene_options(*command, *options);
  command->add_option("--pace", options->pace, "Simulated seconds per second at most: 1 is real time; 0: no limit")
      ->check(number_between(0.0, 1e6));
  command
      ->add_option("--threads", options->threads, "Number of threads for steps in which hundreds of bodies are awake")
      ->check(whole_number());
  add_output_options(*command, *options);
  command->callback([options, &exit_code] { exit_code = run_scene(*options); });
}

}  // namespace talus

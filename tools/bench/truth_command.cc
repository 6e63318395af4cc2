#include "tools/bench/truth_command.h"

#include <memory>

#include "tools/bench/truth.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

constexpr const char* truth_footer =
    "A cell is named by the values of all factors, as 2d-f0.2-L-r6.6-slope-g9.81: friction 0.2, L shapes, 6.6 bodies "
    "a\n"
    "second, a slope, gravity 9.81 m/s^2. --cells takes any of these names, or a part of the names in the design. The\n"
    "folder's scenes/NAME.toml runs with `talus run`. Runs of full and of the reference are kept as long as the scene\n"
    "is the same, those of adaptive until the program or --set changes.\n"
    "Example: talus bench truth --quick --cells 2d-f0.2,slope --seeds 8 --set policy.adaptive.wake_height=0.01";

void add_truth_options(CLI::App& command, TruthOptions& options) {
  command.add_flag("-q,--quick", options.quick,
                   "Ten minutes on two cores: 60 bodies a cell, 4 seeds, one engine, not the scenes of the paper");
  CLI::Option* cells =
      command.add_option("--cells", options.cells, "Cells whose name is or contains one of these; separated by commas")
          ->delimiter(',');
  command
      .add_option("--scenes", options.scenes,
                  "Scene files, folders of them or names, measured in place of cells; each runs as long as its frames")
      ->type_name("FILE|FOLDER|NAME")
      ->excludes(cells);
  command
      .add_option("--design", options.design,
                  "Seed of the covering design (1: 60 cells and the paper's scenes; others: 20)")
      ->check(whole_number());
  command.add_option("--count", options.count, "Cells of the design, from its start")->check(CLI::Range(1, 1000));
  command.add_option("--seeds", options.seeds, "Independent seeds of each cell (16, quick: 4)")
      ->check(CLI::Range(2, 1000));
  command.add_option("--bodies", options.bodies, "Bodies of a cell (200, quick: 60); at 0.5 a second 30 % of them")
      ->check(CLI::Range(10, 100000));
  std::vector<std::string> engines = backends(2);
  for (const std::string& engine : backends(3)) engines.push_back(engine);
  command
      .add_option("-b,--backend", options.backends,
                  "Engine, may be repeated; default: all, quick: each dimension's first")
      ->check(CLI::IsMember(engines))
      ->allow_extra_args(false);
  command
      .add_option("-s,--set", options.settings, "Replace a value of each scene, for adaptive alone; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  command.add_option("-j,--jobs", options.jobs, "Runs at a time, each in a process of its own")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command.add_option("-o,--out", options.out, "Folder of rows and report (bench/truth, quick: bench/truth-quick)")
      ->check(not_empty())
      ->check(CLI::ExistingDirectory | CLI::NonexistentPath);
}

}  // namespace

void add_truth_command(CLI::App& bench, int& exit_code) {
  CLI::App* command = bench.add_subcommand(
      "truth", "Errors of adaptive in scenes that cover friction, shape, pour, ground and gravity");
  command->footer(truth_footer);
  auto options = std::make_shared<TruthOptions>();
  add_truth_options(*command, *options);
  command->callback([=, &exit_code] {
    bench_truth(*options);
    exit_code = exit_codes::success;
  });
}

}  // namespace talus

#include <fmt/format.h>

#include <memory>

#include "common/math/require.h"
#include "common/text/file.h"
#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/record/record_file.h"
#include "tools/record/recorded_run.h"
#include "tools/view/page.h"

namespace talus {
namespace {

struct ReplayOptions {
  std::string run;
  std::string out;
};

void write_replay(const ReplayOptions& options) {
  require(options.out.ends_with(".html"), "--out", options.out, "must end in .html");
  refuse_own_file(options.run, options.out);
  const std::string page = page_with(record_bytes(options.run), name_of_run(options.run));
  write_file(options.out, page);
  print_result("{}: {:.0f} kB\n", printable(options.out), static_cast<double>(page.size()) / 1e3);
}

}  // namespace

void add_replay_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("replay", "Make a page that plays a recorded run, in one file");
  auto options = std::make_shared<ReplayOptions>();
  command->add_option("run", options->run, "Run folder, as `talus run` leaves it, or its record")
      ->required()
      ->check(not_empty());
  command
      ->add_option("-o,--out", options->out,
                   "Page to write, .html, overwritten if there; a browser opens it without a net")
      ->required()
      ->check(file_to_write());
  command->footer("Example:\n  talus run drop_in_a_pile_2d --out runs/pour\n  talus replay runs/pour --out pour.html");
  command->callback([options, &exit_code] {
    write_replay(*options);
    exit_code = exit_codes::success;
  });
}

}  // namespace talus

// The talus command.

#include <fmt/format.h>

#include "common/scene/scene_errors.h"
#include "common/text/printable.h"
#include "tools/bench/bench_command.h"
#include "tools/commands/commands.h"
#ifdef TALUS_BULLET
#include "tools/mesh/decompose_command.h"
#endif
#ifdef TALUS_LCM
#include "tools/monitor/monitor_command.h"
#include "tools/record/record_commands.h"
#endif
#include "tools/run/version.h"

// NOLINTNEXTLINE(bugprone-exception-escape): only a failure to print an error's text gets out
int main(int argc, char** argv) {
  CLI::App app("talus: piles of rigid bodies, simulated faster by freezing who need not move", "talus");
  app.set_version_flag("--version", talus::version_text() + ", " + talus::build_text());
  app.require_subcommand(1);
  int exit_code = talus::exit_codes::success;
  talus::add_run_command(app, exit_code);
  talus::add_list_command(app, exit_code);
  talus::add_check_command(app, exit_code);
  talus::add_bench_command(app, exit_code);
  talus::add_sheet_command(app, exit_code);
#ifdef TALUS_BULLET
  talus::add_decompose_command(app);
#endif
#ifdef TALUS_LCM
  talus::add_monitor_command(app);
  talus::add_compare_command(app, exit_code);
  talus::add_wake_command(app, exit_code);
  talus::add_film_command(app, exit_code);
#endif
  try {
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& error) {
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? talus::exit_codes::success : talus::exit_codes::bad_input;
  } catch (const talus::SceneErrors& errors) {
    fmt::print(stderr, "{}\n", talus::printable_lines(errors.what()));
    return talus::exit_codes::bad_input;
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "talus: {}\n", talus::printable_lines(error.what()));
    return talus::exit_codes::bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "talus: {}\n", talus::printable_lines(error.what()));
    return talus::exit_codes::failed;
  }
  return exit_code;
}

// The talus command.

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <new>
#include <string>
#include <vector>

#include "common/scene/diagnostics.h"
#include "common/text/printable.h"
#include "tools/commands/command_line_text.h"
#include "tools/commands/commands.h"
#ifdef TALUS_BULLET
#include "sim3d/plain_heap.h"
#endif
#include "tools/output/output.h"
#include "tools/run/huge_pages.h"
#include "tools/run/version.h"

namespace {

/// The libraries' warnings go where the command's own go.
void send_log_to_standard_error() {
  spdlog::set_default_logger(spdlog::stderr_color_mt("talus"));
  spdlog::set_pattern("%l: %v");
}

void add_commands(CLI::App& app, int& exit_code) {
  talus::add_run_command(app, exit_code);
  talus::add_new_command(app, exit_code);
  talus::add_list_command(app, exit_code);
  talus::add_check_command(app, exit_code);
  talus::add_bench_command(app, exit_code);
  talus::add_stress_command(app, exit_code);
  talus::add_sweep_command(app, exit_code);
  talus::add_reference_command(app, exit_code);
#ifdef TALUS_BULLET
  talus::add_decompose_command(app, exit_code);
#endif
#ifdef TALUS_LCM
  talus::add_view_command(app, exit_code);
  talus::add_monitor_command(app, exit_code);
  talus::add_compare_command(app, exit_code);
  talus::add_film_command(app, exit_code);
  talus::add_replay_command(app, exit_code);
  talus::add_export_command(app, exit_code);
  talus::add_info_command(app, exit_code);
#endif
}

/// The message about a word that is neither a sub-command nor an option.
void print_unknown(const CLI::App& app, const std::string& word) {
  const std::string nearest = talus::nearest_word(app, word);
  talus::print_message("talus: {}: must be a sub-command or an option{}; see --help", word,
                       nearest.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", nearest));
}

/// Reads and executes the command line; returns the exit code.
int execute(int argc, char** argv) {
  CLI::App app("talus: piles of rigid bodies, simulated faster by freezing bodies at rest", "talus");
  app.set_version_flag("--version", talus::version_text() + ", " + talus::build_text());
  app.require_subcommand(1);
  app.formatter(std::make_shared<talus::PlainHelp>());
  int exit_code = talus::exit_codes::success;
  add_commands(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const std::vector<std::string> unknown = app.remaining(true);
    if (error.get_exit_code() != 0 && !unknown.empty()) {
      print_unknown(app, unknown.front());
      return talus::exit_codes::bad_input;
    }
    return app.exit(error) == 0 ? talus::exit_codes::success : talus::exit_codes::bad_input;
  } catch (const talus::SceneErrors& errors) {
    talus::write_message(errors.what());
    return talus::exit_codes::bad_input;
  } catch (const std::invalid_argument& error) {
    talus::print_message("talus: {}", error.what());
    return talus::exit_codes::bad_input;
  } catch (const std::bad_alloc&) {
    talus::write_message("talus: out of memory");
    return talus::exit_codes::failed;
  } catch (const std::exception& error) {
    talus::print_message("talus: {}", error.what());
    return talus::exit_codes::failed;
  }
  return exit_code;
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): only a failure to make an error's text gets out
int main(int argc, char** argv) {
  talus::prefer_huge_pages();
#ifdef TALUS_BULLET
  talus::use_plain_heap_in_bullet();
#endif
  talus::prepare_output();
  send_log_to_standard_error();
  const int exit_code = execute(argc, argv);
  try {
    talus::flush_results();
  } catch (const std::system_error& error) {
    if (exit_code != talus::exit_codes::success) return exit_code;  // of which a message has been printed
    talus::print_message("talus: {}", error.what());
    return talus::exit_codes::failed;
  }
  return exit_code;
}

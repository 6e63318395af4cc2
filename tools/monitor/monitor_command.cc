#include <CLI/CLI.hpp>
#include <iostream>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <stdexcept>
#include <string>

#include "lcmtypes/live_link.h"
#include "tools/commands/commands.h"
#include "tools/monitor/monitor.h"
#include "tools/monitor/receive.h"
#include "tools/monitor/run_view.h"
#include "tools/monitor/terminal_screen.h"
#include "tools/output/interrupt.h"
#include "tools/output/output.h"

namespace talus {
namespace {

/// Why the address cannot be used; empty where it can.
std::string problem_with(const std::string& url) { return open_live_link(url).problem; }

int run_monitor(const MonitorParams& params, const std::string& url) {
  check_url(url);
  const std::string address = receiving_url(url);
  if (const std::string problem = problem_with(address); !problem.empty()) {
    print_message("talus monitor: {}", problem);
    return exit_codes::failed;
  }
  ReceiverProcess receiver(receive_at(address));
  const Interrupt interrupt;
  const auto stop = [&interrupt] { return interrupt.requested(); };
  std::unique_ptr<TerminalScreen> screen = params.json || params.plain ? nullptr : TerminalScreen::open();
  if (!screen) return monitor(receiver, params, std::cout, stop);
  return watch_on_screen(receiver, params, effective_url(url), std::move(screen), std::cout, stop);
}

}  // namespace

void add_monitor_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "monitor", "Watch running simulations over LCM: a full screen in a terminal, else a line per second and run");
  const auto params = std::make_shared<MonitorParams>();
  const auto url = std::make_shared<std::string>();
  command->add_option("--lcm-url", *url, "Where to listen; else LCM_DEFAULT_URL, else this machine's runs")
      ->check(not_empty());
  command->add_option("--seconds", params->seconds, "Stop after so many seconds; else Ctrl-C stops")
      ->check(number_between(0.0, 1e9, Bound::left_out));
  command->add_option("--interval", params->interval, "Seconds between two lines of one run")
      ->check(number_between(0.0, MonitorParams::longest_interval, Bound::left_out))
      ->capture_default_str();
  command->add_flag("--json", params->json, "One JSON object a line, for programs");
  command->add_flag("--plain", params->plain, "A line of text per second and run, also in a terminal")
      ->excludes("--json");
  command->add_flag("--fail-on-loss", params->fail_on_loss,
                    "Exit with 1 when anything sent could not be shown (messages lost or undecodable, runs\n"
                    "dropped, crashes of the receiver), or no run was heard");
  command->footer(
      "The keys of the screen: ? lists them. A bar of a line shows the density of a pile's layers, bottom first. "
      "\"lost\" counts messages that this monitor missed;\n"
      "against that, as root: sysctl -w net.core.rmem_max=4194304, of which the monitor takes all. The record of the "
      "run is complete in any case.");
  command->callback([params, url, &exit_code] { exit_code = run_monitor(*params, *url); });
}

}  // namespace talus

#include "tools/monitor/monitor_command.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <iostream>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>

#include "lcmtypes/live_link.h"
#include "tools/monitor/monitor.h"

namespace talus {
namespace {

// A signal handler reaches nothing but globals.
std::atomic<bool> interrupted = false;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<bool>::is_always_lock_free);

int run_monitor(const MonitorParams& params, const std::string& url) {
  LiveLink link = open_live_link(url);
  if (!link.lcm) {
    std::cerr << "talus monitor: " << link.problem << '\n';
    return 1;
  }
  std::signal(SIGINT, [](int) { interrupted = true; });
  std::signal(SIGTERM, [](int) { interrupted = true; });
  return monitor(*link.lcm, params, std::cout, interrupted);
}

}  // namespace

void add_monitor_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("monitor", "Watch running simulations over LCM, a line per second and run");
  const auto params = std::make_shared<MonitorParams>();
  const auto url = std::make_shared<std::string>();
  command->add_option("--lcm-url", *url, "Where to listen; else LCM_DEFAULT_URL, else this machine's runs");
  command->add_option("--seconds", params->seconds, "Stop after so many seconds; else Ctrl-C stops")
      ->check(CLI::PositiveNumber);
  command->add_option("--interval", params->interval, "Seconds between two lines of one run")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--json", params->json, "One JSON object a line, for programs");
  command->add_flag("--fail-on-loss", params->fail_on_loss,
                    "Exit with 1 when a message was lost or undecodable, or no run was heard");
  command->footer(
      "A bar shows the density of a pile's layers, bottom first. \"lost\" counts messages that this monitor missed;\n"
      "against that: export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304'\n"
      "and, as root: sysctl -w net.core.rmem_max=4194304. The record of the run is complete in any case.");
  command->callback([params, url] {
    const int code = run_monitor(*params, *url);
    if (code != 0) throw CLI::RuntimeError(code);
  });
}

}  // namespace talus

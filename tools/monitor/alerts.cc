#include <fmt/format.h>

#include "common/policy/frame.h"
#include "lcmtypes/run_info.h"
#include "tools/monitor/panels.h"
#include "tools/monitor/text_view.h"

namespace talus {
namespace {

bool is_recent(const Wave& wave, const RunView& view) {
  constexpr double recent = 10.0;  // [s] simulated
  return view.run() && static_cast<double>(view.step() - wave.step) * view.run()->dt <= recent;
}

void add_alerts(const Heard& heard, const HeardRun& run, std::vector<std::string>& alerts) {
  const RunView& view = run.view();
  const std::string name = short_id(run.id);
  if (view.stats()) {
    for (const Warning& warning : view.reader().moment().warnings)
      alerts.push_back(fmt::format("{}: warning: {}", name, account(warning)));
    if (view.stats()->dropped > 0)
      alerts.push_back(fmt::format("{}: the sender dropped {} messages", name, view.stats()->dropped));
  }
  if (view.lost() > 0) {
    alerts.push_back(fmt::format("{}: {} of {} messages lost; cure: sysctl -w net.core.rmem_max=4194304", name,
                                 view.lost(), sum_of_counts(view.lost(), view.received())));
  }
  if (const Wave& wave = view.sleep().wave(); wave.bodies > 0 && is_recent(wave, view)) {
    alerts.push_back(
        fmt::format("{}: {} bodies woke in step {}: {}", name, wave.bodies, wave.step, to_string(wave.cause)));
  }
  if (const std::string state = state_of(heard, run); state.starts_with("silent"))
    alerts.push_back(fmt::format("{}: {}", name, state));
}

}  // namespace

std::vector<std::string> alerts_of(const Heard& heard) {
  std::vector<std::string> alerts;
  for (const HeardRun& run : runs_of(heard)) add_alerts(heard, run, alerts);
  if (!heard.faults.none()) alerts.push_back(text_line(heard.faults));
  return alerts;
}

}  // namespace talus

#include "tools/monitor/monitor.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <ostream>
#include <stdexcept>

#include "tools/monitor/json_view.h"
#include "tools/monitor/listener.h"
#include "tools/monitor/text_view.h"

namespace talus {
namespace {

using Clock = std::chrono::steady_clock;

void check(const MonitorParams& params) {
  if (!(params.seconds > 0.0)) throw std::invalid_argument(fmt::format("seconds = {}: must be > 0", params.seconds));
  if (!(params.interval > 0.0)) throw std::invalid_argument(fmt::format("interval = {}: must be > 0", params.interval));
}

/// Prints what there is, and keeps the sums that the exit code depends on.
class Reporter {
 public:
  Reporter(Listener& listener, const MonitorParams& params, std::ostream& out)
      : listener_(listener), params_(params), out_(out) {}

  void report() {
    for (const auto& [run_id, view] : listener_.runs()) {
      heard_ = true;
      if (told_.contains(run_id) && view.received() == told_.at(run_id)) continue;  // silent since
      told_[run_id] = view.received();
      out_ << (params_.json ? json_line(run_id, view, listener_.undecodable()) : text_line(run_id, view)) << '\n';
    }
    std::erase_if(told_, [this](const auto& entry) { return !listener_.runs().contains(entry.first); });
    if (!params_.json && listener_.undecodable() > undecodable_told_) {
      out_ << fmt::format("undecodable {}, the last one on {}\n", listener_.undecodable(), listener_.last_fault());
    }
    undecodable_told_ = listener_.undecodable();
    out_.flush();
  }

  bool flawless() const { return heard_ && listener_.lost() == 0 && listener_.undecodable() == 0; }

 private:
  Listener& listener_;
  const MonitorParams& params_;
  std::ostream& out_;
  std::map<std::int64_t, std::int64_t> told_;  // by run: messages received when last printed
  std::int64_t undecodable_told_ = 0;
  bool heard_ = false;
};

int milliseconds_until(Clock::time_point then) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(then - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 100));  // 100: how soon `stop` is seen
}

}  // namespace

int monitor(lcm::LCM& lcm, const MonitorParams& params, std::ostream& out, const std::atomic<bool>& stop) {
  check(params);
  Listener listener(lcm);
  Reporter reporter(listener, params, out);
  const auto interval = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(params.interval));
  const auto begin = Clock::now();
  auto next_report = begin + interval;
  while (!stop && out && std::chrono::duration<double>(Clock::now() - begin).count() < params.seconds) {
    if (lcm.handleTimeout(milliseconds_until(next_report)) < 0 && !stop) {
      throw std::runtime_error("LCM stopped receiving");
    }
    if (Clock::now() < next_report) continue;
    reporter.report();
    next_report += interval;
  }
  const auto last_call = Clock::now() + std::chrono::milliseconds(100);
  while (Clock::now() < last_call && lcm.handleTimeout(0) > 0) {  // what had arrived by then
  }
  reporter.report();
  return params.fail_on_loss && !reporter.flawless() ? 1 : 0;
}

}  // namespace talus

#include "tools/monitor/monitor.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <ostream>
#include <stdexcept>

#include "tools/monitor/faults.h"
#include "tools/monitor/json_view.h"
#include "tools/monitor/listener.h"
#include "tools/monitor/pages.h"
#include "tools/monitor/receiver_process.h"
#include "tools/monitor/terminal_screen.h"
#include "tools/monitor/text_view.h"
#include "tools/output/output.h"

namespace talus {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::milliseconds;

void check(const MonitorParams& params) {
  if (!(params.seconds > 0.0)) throw std::invalid_argument(fmt::format("seconds = {}: must be > 0", params.seconds));
  if (!(params.interval > 0.0 && params.interval <= MonitorParams::longest_interval)) {
    throw std::invalid_argument(
        fmt::format("interval = {}: must be > 0 and at most {}", params.interval, MonitorParams::longest_interval));
  }
}

/// Prints what there is, and keeps the sums that the exit code depends on.
class Reporter {
 public:
  Reporter(Listener& listener, const ReceiverProcess& receiver, const MonitorParams& params, std::ostream& out)
      : listener_(listener), receiver_(receiver), params_(params), out_(out) {}

  void report() {
    const Faults faults = faults_of(listener_, receiver_);
    for (auto& [run_id, entry] : listener_.runs().entries()) {
      heard_ = true;
      if (entry.view.received() == entry.printed) continue;  // silent since
      entry.printed = entry.view.received();
      out_ << (params_.json ? json_line(run_id, entry.view, faults) : text_line(run_id, entry.view)) << '\n';
    }
    if (faults != printed_) out_ << (params_.json ? json_line(faults) : text_line(faults)) << '\n';
    printed_ = faults;
    if (!out_.flush()) throw std::runtime_error("standard output cannot be written");
  }

  /// Of the program, at the end.
  int exit_code() const {
    if (!params_.fail_on_loss) return exit_codes::success;
    if (!heard_) print_message("talus monitor: no run was heard");
    const bool flawless = heard_ && listener_.runs().lost() == 0 && faults_of(listener_, receiver_).none();
    return flawless ? exit_codes::success : exit_codes::failed;
  }

 private:
  Listener& listener_;
  const ReceiverProcess& receiver_;
  const MonitorParams& params_;
  std::ostream& out_;
  Faults printed_;
  bool heard_ = false;
};

Milliseconds time_until(Clock::time_point then) {
  constexpr Milliseconds longest(100);  // how soon `stop` is seen
  return std::clamp(std::chrono::duration_cast<Milliseconds>(then - Clock::now()), Milliseconds(0), longest);
}

bool time_is_up(const MonitorParams& params, Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count() >= params.seconds;
}

/// Takes what arrives until then, at most 100 ms.
void hear_until(Clock::time_point then, ReceiverProcess& receiver, Listener& listener) {
  if (const auto datagram = receiver.next(time_until(then))) listener.hear(*datagram);
}

/// Takes what had arrived when all was over.
void hear_the_rest(ReceiverProcess& receiver, Listener& listener) {
  const auto last_call = Clock::now() + Milliseconds(100);
  while (Clock::now() < last_call) hear_until(last_call, receiver, listener);
}

/// Draws what was heard and obeys the keys.
class Watch {
 public:
  Watch(TerminalScreen& screen, const Listener& listener, const ReceiverProcess& receiver, const std::string& address)
      : screen_(screen), listener_(listener), receiver_(receiver), address_(address) {}

  /// Draws where it is time to. False when the user quits.
  bool update() {
    const auto now = Clock::now();
    bool redraw = now >= next_drawing_ && !choice_.held;
    const Heard heard = {listener_, faults_of(listener_, receiver_), address_, now};
    for (int key = TerminalScreen::key(); key != TerminalScreen::no_key; key = TerminalScreen::key()) {
      redraw = true;
      if (obey(key, heard, choice_) == Effect::quit) return false;
    }
    if (!redraw) return true;
    Sheet sheet(TerminalScreen::rows(), TerminalScreen::columns());
    draw(heard, choice_, sheet);
    screen_.show(sheet);
    next_drawing_ = now + between_drawings;
    return true;
  }

 private:
  static constexpr auto between_drawings = Milliseconds(200);

  TerminalScreen& screen_;
  const Listener& listener_;
  const ReceiverProcess& receiver_;
  const std::string& address_;
  Choice choice_;
  Clock::time_point next_drawing_{};
};

}  // namespace

int monitor(ReceiverProcess& receiver, const MonitorParams& params, std::ostream& out,
            const std::function<bool()>& stop) {
  check(params);
  Listener listener;
  Reporter reporter(listener, receiver, params, out);
  const auto interval = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(params.interval));
  const auto begin = Clock::now();
  auto next_report = begin + interval;
  while (!stop() && out && !time_is_up(params, begin)) {
    hear_until(next_report, receiver, listener);
    if (Clock::now() < next_report) continue;
    reporter.report();
    next_report += interval;
  }
  hear_the_rest(receiver, listener);
  reporter.report();
  return reporter.exit_code();
}

int watch_on_screen(ReceiverProcess& receiver, const MonitorParams& params, const std::string& address,
                    std::unique_ptr<TerminalScreen> screen, std::ostream& out, const std::function<bool()>& stop) {
  check(params);
  Listener listener;
  Watch watch(*screen, listener, receiver, address);
  const auto begin = Clock::now();
  auto next_update = begin;
  for (bool goes_on = true; goes_on && !stop() && !time_is_up(params, begin);) {
    hear_until(next_update, receiver, listener);
    if (Clock::now() < next_update) continue;
    goes_on = watch.update();
    next_update = Clock::now() + Milliseconds(20);
  }
  screen.reset();
  hear_the_rest(receiver, listener);
  Reporter reporter(listener, receiver, params, out);
  reporter.report();
  return reporter.exit_code();
}

}  // namespace talus

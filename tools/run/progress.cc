#include "tools/run/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "tools/output/output.h"
#include "tools/run/run_statistics.h"

namespace talus {
namespace {

std::string as_time(double seconds) {
  const auto whole = std::lround(seconds);
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} s", whole);
}

}  // namespace

template <int Dim>
Progress<Dim>::Progress(std::int64_t steps)
    : steps_(steps), terminal_(isatty(STDERR_FILENO) != 0), interval_(terminal_ ? 0.1 : 5.0) {}

template <int Dim>
void Progress<Dim>::on_frame(const Frame<Dim>& frame) {
  since_line_ += watch_.lap();
  if (since_line_ >= interval_) write(frame);
}

template <int Dim>
void Progress<Dim>::write(const Frame<Dim>& frame) {
  elapsed_ += since_line_;
  const auto awake = frame.world.awake().size();
  const auto done = static_cast<double>(frame.step);
  const double left = elapsed_ * (static_cast<double>(steps_) - done) / done;
  const double step_ms = 1e3 * since_line_ / static_cast<double>(frame.step - line_step_);
  std::string line = fmt::format("step {}/{}  {:.0f} %  left {}  awake {}  asleep {}  {:.3f} ms a step", frame.step,
                                 steps_, 100.0 * done / static_cast<double>(steps_), as_time(left), awake,
                                 bodies_asleep(frame.world), step_ms);
  if (terminal_) {
    line.resize(std::min(line.size(), static_cast<std::size_t>(terminal_width(STDERR_FILENO) - 1)));
    write_note("\r\x1b[K" + line);
  } else {
    write_message(line);
  }
  since_line_ = 0.0;
  line_step_ = frame.step;
}

template <int Dim>
void Progress<Dim>::on_end(const Frame<Dim>&, std::string_view) {
  if (terminal_) write_note("\r\x1b[K");
}

template class Progress<2>;
template class Progress<3>;

template <int Dim>
void WarningPrinter<Dim>::print(const Frame<Dim>& frame) {
  for (; printed_ < frame.warnings.size(); ++printed_) {
    if (isatty(STDERR_FILENO) != 0) write_note("\r\x1b[K");  // the line of progress
    print_message("warning: {}", advice(frame.warnings[printed_]));
  }
}

template class WarningPrinter<2>;
template class WarningPrinter<3>;

}  // namespace talus

#pragma once

#include <functional>
#include <iosfwd>
#include <limits>
#include <memory>
#include <string>

namespace talus {

class ReceiverProcess;
class TerminalScreen;

struct MonitorParams {
  double seconds = std::numeric_limits<double>::infinity();  // [s] of wall time, > 0: when to stop
  double interval = 1.0;      // [s] of wall time, in (0, longest_interval]: between two lines of one run
  bool json = false;          // lines for programs instead of people
  bool plain = false;         // lines also where there is a terminal
  bool fail_on_loss = false;  // exit code 1 when anything sent could not be shown, or no run was heard

  static constexpr double longest_interval = 86400.0;
};

/// Shows what is heard on `address` until time is up, a key or `stop` ends it; a screen that can be drawn is drawn five
/// times a second. At the end, once the screen is closed, prints a line per run to `out`. Else as below.
int watch_on_screen(ReceiverProcess& receiver, const MonitorParams& params, const std::string& address,
                    std::unique_ptr<TerminalScreen> screen, std::ostream& out, const std::function<bool()>& stop);

/// Prints a line per interval and run to `out` until time is up or `stop` returns true; runs that ended get one last
/// line. Faults (see Faults) are printed in the interval in which they occur. Returns the exit code. Throws
/// std::invalid_argument on bad parameters.
int monitor(ReceiverProcess& receiver, const MonitorParams& params, std::ostream& out,
            const std::function<bool()>& stop);

}  // namespace talus

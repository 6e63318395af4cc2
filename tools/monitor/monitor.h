#pragma once

#include <atomic>
#include <iosfwd>
#include <limits>

namespace lcm {
class LCM;
}

namespace talus {

struct MonitorParams {
  double seconds = std::numeric_limits<double>::infinity();  // [s] of wall time, > 0: when to stop
  double interval = 1.0;                                     // [s] of wall time, > 0: between two lines of one run
  bool json = false;                                         // lines for programs instead of people
  bool fail_on_loss = false;  // exit code 1 when a message was lost or undecodable, or no run was heard
};

/// Prints a line per interval and run to `out` until time is up or `stop` is set; runs that ended get one last line.
/// Returns the exit code. Throws std::invalid_argument on bad parameters.
int monitor(lcm::LCM& lcm, const MonitorParams& params, std::ostream& out, const std::atomic<bool>& stop);

}  // namespace talus

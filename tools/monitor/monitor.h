#pragma once

#include <atomic>
#include <iosfwd>
#include <limits>

namespace talus {

class ReceiverProcess;

struct MonitorParams {
  double seconds = std::numeric_limits<double>::infinity();  // [s] of wall time, > 0: when to stop
  double interval = 1.0;      // [s] of wall time, in (0, longest_interval]: between two lines of one run
  bool json = false;          // lines for programs instead of people
  bool fail_on_loss = false;  // exit code 1 when anything sent could not be shown, or no run was heard

  static constexpr double longest_interval = 86400.0;
};

/// Prints a line per interval and run to `out` until time is up or `stop` is set; runs that ended get one last line.
/// Faults (see Faults) are printed in the interval in which they occur. Returns the exit code. Throws
/// std::invalid_argument on bad parameters.
int monitor(ReceiverProcess& receiver, const MonitorParams& params, std::ostream& out, const std::atomic<bool>& stop);

}  // namespace talus

#pragma once

#include <cstdint>
#include <string>

namespace talus {

class Listener;
class ReceiverProcess;

/// All that kept a monitor from showing what was sent, apart from messages lost on the way.
struct Faults {
  std::int64_t undecodable = 0;        // messages of another kind or damaged
  std::string last_undecodable;        // channel, and what was wrong
  std::int64_t receiver_crashes = 0;   // see ReceiverProcess
  std::string last_crash;              // how it ended
  std::int64_t restart_delay_ms = 0;   // from the last crash to the start after it
  std::int64_t dropped_runs = 0;       // see RunTable
  std::int64_t last_dropped = 0;       // number of the run
  std::int64_t unplaced_messages = 0;  // of runs that found no room
  std::int64_t piles_left_out = 0;     // of the runs that are shown

  bool operator==(const Faults&) const = default;
  bool none() const { return *this == Faults{}; }
};

Faults faults_of(const Listener& listener, const ReceiverProcess& receiver);

}  // namespace talus

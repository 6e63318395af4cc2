#include "tools/monitor/faults.h"

#include "tools/monitor/listener.h"
#include "tools/monitor/receiver_process.h"

namespace talus {

Faults faults_of(const Listener& listener, const ReceiverProcess& receiver) {
  const RunTable& runs = listener.runs();
  Faults faults{.undecodable = listener.undecodable(),
                .last_undecodable = listener.last_fault(),
                .receiver_crashes = receiver.crashes(),
                .last_crash = receiver.last_crash(),
                .restart_delay_ms = receiver.restart_delay().count(),
                .dropped_runs = runs.dropped(),
                .last_dropped = runs.last_dropped(),
                .unplaced_messages = runs.unplaced()};
  for (const auto& [run_id, entry] : runs.entries())
    faults.piles_left_out = sum_of_counts(faults.piles_left_out, entry.view.reader().piles_left_out());
  return faults;
}

}  // namespace talus

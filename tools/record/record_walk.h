#pragma once
// A record from its beginning to its end, holding one moment at a time.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/moment/moment.h"
#include "lcmtypes/log_reader.h"
#include "lcmtypes/moment_reader.h"

namespace talus {

/// What a walk had to leave out.
struct WalkDamage {
  std::uint64_t bytes = 0;       // that are no message
  std::int64_t undecodable = 0;  // messages whose checksum holds and that are of another kind all the same
  std::int64_t lost_events = 0;  // messages with sleep events that are missing between others
  std::int64_t missing = 0;      // messages of all channels that are missing between others

  bool none() const { return bytes == 0 && undecodable == 0 && missing == 0; }
};

/// The run's identity and end, from the record, of any bytes. Empty where no message has it.
struct RecordedIdentity {
  std::string backend;
  std::string policy;
  std::string version;  // of talus that made the run
  std::string reason;   // why it ended; empty: it was killed
};

struct WalkResult {
  WalkDamage damage;
  RecordedIdentity run;
  Moment last;
  std::vector<SleepEvent> later_events;  // that are in no moment visited
};

/// Calls `visit` with each moment in order, the last one as the end of the run tells it. Throws std::invalid_argument
/// where the record is not of `scene`, of another format or of several runs; `file` is for the message.
template <int Dim>
WalkResult walk_record(const Scene<Dim>& scene, LogReader& log, const std::filesystem::path& file,
                       const std::function<void(const Moment&)>& visit);

}  // namespace talus

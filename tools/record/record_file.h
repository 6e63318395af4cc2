#pragma once
// The file of a record, message by message.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "lcmtypes/log_reader.h"

namespace talus {

/// The log of a run folder, or the path itself where it is a file. Throws std::invalid_argument where it is neither.
std::filesystem::path record_file(const std::filesystem::path& run);

/// Throws std::invalid_argument where `out`, by links too, is the record of `run` or what some run left in its folder.
void refuse_own_file(const std::filesystem::path& run, const std::string& out);

/// The error of a file that holds no event.
std::invalid_argument no_event_log(const std::filesystem::path& file);

/// Whether a file begins as an LCM event log does.
bool is_event_log(const std::filesystem::path& file);

/// What every message begins with.
struct MessageHeader {
  std::int64_t utime = 0;  // [us]
  std::int64_t run_id = 0;
  std::int64_t step = 0;
  double time = 0.0;  // [s] simulated
  std::int64_t seq = 0;
};
/// Of an event on one of our channels.
MessageHeader header_of(const LogEvent& event);

/// Throws std::invalid_argument where the event is of a run of another format than this version reads.
void refuse_other_format(const LogEvent& event, const std::filesystem::path& file);

/// Whether the event is on one of the channels of a run.
bool is_of_run(const LogEvent& event);

/// Sees that all messages are of one run.
class OneRun {
 public:
  /// Throws std::invalid_argument where the event is of another run than those before; `file` is for the message.
  void see(const LogEvent& event, const std::filesystem::path& file);

 private:
  std::optional<std::int64_t> run_;
};

/// All fields of a message of a run; null where it is of no type that this version has.
nlohmann::ordered_json message_json(const LogEvent& event);

}  // namespace talus

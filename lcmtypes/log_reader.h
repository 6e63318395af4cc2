#pragma once

#include <cstdint>
#include <istream>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace talus {

/// What an event begins with in a file, where all numbers are big-endian: this (4 bytes), number (8), stamp (8), length
/// of the channel's name (4), length of the data (4), name, data (LCM 1.3.1, lcm/eventlog.c).
inline constexpr std::uint8_t log_sync_word[4] = {0xED, 0xA1, 0xDA, 0x01};

/// One event of a log. The header (number, stamp) is under no checksum; messages carry stamp and number of their own.
struct LogEvent {
  std::int64_t number = 0;     // as written, from 0
  std::int64_t timestamp = 0;  // [us]
  std::string channel;
  std::vector<std::uint8_t> data;
};

/// What a reader had to leave out.
struct LogDamage {
  std::uint64_t places = 0;  // stretches of bytes that were no event
  std::uint64_t bytes = 0;   // their sum
};

/// Reads LCM event logs, also those that were cut, overwritten or invented to do harm: what is no valid event is
/// skipped byte by byte until the next one. An event on one of our channels is valid when its checksum holds; on any
/// other channel, when the next event or the end of the file follows. LCM's own reader stops at the first damage and
/// crashes on some lengths.
class LogReader {
 public:
  /// Reads a file. Throws std::system_error with the path.
  explicit LogReader(const std::string& path);
  /// Reads a log that lies elsewhere, as in memory.
  explicit LogReader(std::unique_ptr<std::istream> log) : log_(std::move(log)) {}

  /// The next event, or false at the end of the file.
  bool next(LogEvent& event);

  /// Of what was read so far.
  const LogDamage& damage() const { return damage_; }

 private:
  bool have(std::size_t bytes);
  std::span<const std::uint8_t> rest() const { return std::span(buffer_).subspan(at_); }
  std::size_t event_size();
  void skip_to_candidate();

  std::unique_ptr<std::istream> log_;
  std::vector<std::uint8_t> buffer_;  // a stretch of the log; what lies before at_ is done with
  std::size_t at_ = 0;
  LogDamage damage_;
  bool in_damage_ = false;
};

}  // namespace talus

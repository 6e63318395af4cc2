#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lcmtypes/log_reader.h"
#include "lcmtypes/wire.h"

namespace lcm {
class LogFile;
}

namespace talus {

/// Adds an event to a log in memory, laid out as in a file (log_reader.h).
void append_event(std::string& log, std::int64_t number, std::int64_t stamp, Channel channel,
                  std::span<const std::uint8_t> data);

/// An LCM event log being written: lcm-logplayer plays it, lcm-spy shows it. Each event's stamp is its message's utime.
class EventLog {
 public:
  /// Makes or empties the file. Throws std::system_error with the path.
  explicit EventLog(std::string path);
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;
  ~EventLog();

  /// Appends. Throws std::system_error, also for what was written before and only now turns out not to fit the disk.
  /// Once it has thrown, it and flush() do nothing: what is in the file stays readable.
  void write(Packet& packet);
  /// The same for an event of another log, with its stamp; its number is its place in this one.
  void write(LogEvent& event);

  /// Hands all that was written to the operating system: then it outlives this process, whatever ends it.
  void flush();

  /// flush() when the last one was `interval` [s] of wall time ago or longer.
  void flush_after(double interval);

 private:
  void write(std::int64_t stamp, const std::string& channel, std::vector<std::uint8_t>& data);
  [[noreturn]] void fail();

  std::string path_;
  std::unique_ptr<lcm::LogFile> file_;
  bool broken_ = false;
  std::chrono::steady_clock::time_point last_flush_ = std::chrono::steady_clock::now();
};

}  // namespace talus

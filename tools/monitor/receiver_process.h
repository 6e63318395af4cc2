#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lcmtypes/channels.h"

namespace talus {

/// A message as it came from the network, unchecked.
struct Datagram {
  Channel channel = Channel::run;
  std::vector<std::uint8_t> bytes;  // of a message above max_message_bytes only its beginning, one byte too long
};

/// What a receiving process sends datagrams through. Both calls end the process when the other side is gone.
class DatagramSender {
 public:
  explicit DatagramSender(int socket) : socket_(socket) {}
  void send(Channel channel, const void* bytes, std::size_t size) const;
  /// A sign of life, due at least each second while no datagram is sent.
  void alive() const;

 private:
  int socket_;
};

/// Receives in a child process, because forged packets can crash LCM 1.3.1: a child that dies is counted and started
/// again. A child that is silent for `stall_limit` is killed and counted too.
class ReceiverProcess {
 public:
  using Clock = std::chrono::steady_clock;
  /// Runs in the child until it is killed; a return or an exception counts as a crash.
  using Body = std::function<void(const DatagramSender&)>;

  static constexpr auto stall_limit = std::chrono::seconds(5);
  // Delay of the next start after a crash: `first_delay`, doubled with each crash in a row, at most `longest_delay`. A
  // child that lived for `sound_life` ends the row.
  static constexpr auto first_delay = std::chrono::milliseconds(50);
  static constexpr auto longest_delay = std::chrono::milliseconds(500);
  static constexpr auto sound_life = std::chrono::seconds(10);

  /// Starts the first child. The calling process should have one thread only, since the child is a fork without exec.
  explicit ReceiverProcess(Body body);
  ReceiverProcess(const ReceiverProcess&) = delete;
  ReceiverProcess& operator=(const ReceiverProcess&) = delete;
  ~ReceiverProcess();

  /// The next datagram, or nothing when none came within `timeout` or a signal arrived.
  std::optional<Datagram> next(std::chrono::milliseconds timeout);

  std::int64_t crashes() const { return crashes_; }
  /// How the last child ended, as "signal 11 (Segmentation fault)".
  const std::string& last_crash() const { return last_crash_; }
  /// From the last crash to the start after it.
  std::chrono::milliseconds restart_delay() const { return delay_; }
  /// Of the child; -1 between a crash and the next start.
  pid_t pid() const { return pid_; }

 private:
  void start();
  [[noreturn]] void run_child(int socket, pid_t parent);
  std::optional<Datagram> read();
  void bury();
  void note_crash(const std::string& how);

  Body body_;
  pid_t pid_ = -1;
  int socket_ = -1;
  Clock::time_point started_;
  Clock::time_point heard_;       // the last sign of life
  Clock::time_point next_start_;  // when no child runs
  std::chrono::milliseconds delay_{0};
  std::int64_t crashes_ = 0;
  std::string last_crash_;
};

}  // namespace talus

#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "lcmtypes/live_link.h"
#include "lcmtypes/wire.h"

namespace talus {

/// Sends messages from a thread of its own, in order, eight or 8 KiB at a time (a longer burst overruns the receivers'
/// buffers) and then none for 2 ms, less the more is queued, down to 0.1 ms. Messages gather for at most 10 ms. push()
/// never waits for the network: a message that finds the queue full is dropped and counted.
class SendQueue {
 public:
  /// Holds at most `capacity` bytes, and at most so many packets that they can be sent within a second. The last eighth
  /// of both is kept for Channel::run and Channel::stats, so that a full queue can be reported.
  SendQueue(std::unique_ptr<lcm::LCM> lcm, std::size_t capacity);
  /// Sends through the caller's `lcm`, which must live longer than this object.
  SendQueue(lcm::LCM& lcm, std::size_t capacity);
  SendQueue(const SendQueue&) = delete;
  SendQueue& operator=(const SendQueue&) = delete;
  ~SendQueue();

  /// Takes the packet, or drops it.
  void push(Packet packet);

  /// Sends what is queued, for at most `patience`, then for at most 0.2 s the messages of Channel::run and
  /// Channel::stats, and stops. Later packets are dropped.
  void close(std::chrono::milliseconds patience);

  std::size_t queued_bytes() const;
  /// Packets that did not fit or could not be sent.
  std::int64_t dropped() const;

 private:
  struct State {
    std::unique_ptr<lcm::LCM> owned;
    lcm::LCM* lcm = nullptr;
    std::size_t capacity = 0;
    mutable std::mutex mutex;  // guards what follows
    std::condition_variable changed;
    std::deque<Packet> packets;
    std::size_t bytes = 0;
    std::int64_t dropped = 0;
    bool closing = false;
    bool done = false;
  };
  static bool has_room(const State& state, const Packet& packet);
  static void send_all(State& state);
  static void send_burst(State& state, std::unique_lock<std::mutex>& lock);
  void start();

  // Shared with the thread: one that hangs in the network is left behind rather than waited for.
  std::shared_ptr<State> state_;
  std::thread thread_;
};

}  // namespace talus

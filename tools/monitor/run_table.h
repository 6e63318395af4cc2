#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <unordered_map>

#include "tools/monitor/run_view.h"

namespace talus {

/// The runs that a monitor shows, at most `max_runs`. Any process can invent runs, so a full table makes room: for any
/// run in place of one that ended; else for the run heard most often of those without room, in place of the longest
/// silent one or, where all send, of one with fewer messages; runs with many messages take turns. So runs that send
/// once or little can neither drive out nor keep out a run that sends all the time.
class RunTable {
 public:
  using Clock = std::chrono::steady_clock;

  static constexpr std::size_t max_runs = 64;
  // A run counts as silent after this time; a live run sends each second.
  static constexpr auto silence = std::chrono::seconds(2);
  // A run enters a full table with its third message at the earliest, and stays for this time at least if it sends.
  static constexpr int messages_to_enter = 3;
  static constexpr auto stay = std::chrono::seconds(3);
  static constexpr std::int64_t enough_messages = 100;  // from which on runs count as equal and take turns

  struct Entry {
    RunView view;
    Clock::time_point entered;
    Clock::time_point heard;  // the last message
    std::array<RateMeter, channel_names.size()> rates = {};
    std::int64_t printed = 0;  // messages received when it was last printed; 0: never
  };

  /// The run with this number, to which a message came at `now`; nullptr where it finds no room.
  Entry* find(std::int64_t run_id, Clock::time_point now);

  std::map<std::int64_t, Entry>& entries() { return entries_; }
  const std::map<std::int64_t, Entry>& entries() const { return entries_; }

  /// Runs that left the table before their end was printed, and the number of the last one.
  std::int64_t dropped() const { return dropped_; }
  std::int64_t last_dropped() const { return last_dropped_; }
  /// Messages of runs that found no room.
  std::int64_t unplaced() const { return unplaced_; }
  /// Messages missing of all runs, of those that left too.
  std::int64_t lost() const;
  /// Begins the run with this number again.
  void restart(std::int64_t run_id);

 private:
  using Iterator = std::map<std::int64_t, Entry>::iterator;

  bool make_room(std::int64_t run_id, Clock::time_point now);
  bool is_next(std::int64_t run_id);
  void stop_waiting(std::int64_t run_id);
  Iterator longest_silent(bool ended);
  Iterator quietest(Clock::time_point entered_before, std::int64_t at_most);
  void drop(Iterator entry);

  std::map<std::int64_t, Entry> entries_;
  std::unordered_map<std::int64_t, int> waiting_;  // messages heard of runs without room
  int most_heard_ = 0;                             // the largest number of these
  std::int64_t dropped_ = 0;
  std::int64_t last_dropped_ = 0;
  std::int64_t unplaced_ = 0;
  std::int64_t lost_by_dropped_ = 0;
};

}  // namespace talus

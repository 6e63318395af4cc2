#include "tools/monitor/run_table.h"

#include <algorithm>
#include <utility>

namespace talus {
namespace {

// Bounds the memory that invented runs take; a real run sends its third message long before so many others come.
constexpr std::size_t max_waiting = 65536;

}  // namespace

RunTable::Entry* RunTable::find(std::int64_t run_id, Clock::time_point now) {
  auto entry = entries_.find(run_id);
  if (entry == entries_.end()) {
    if (entries_.size() >= max_runs && !make_room(run_id, now)) {
      unplaced_ = sum_of_counts(unplaced_, 1);
      return nullptr;
    }
    stop_waiting(run_id);
    entry = entries_.emplace(run_id, Entry{}).first;
    entry->second.entered = now;
  }
  entry->second.heard = now;
  return &entry->second;
}

bool RunTable::make_room(std::int64_t run_id, Clock::time_point now) {
  auto leaving = longest_silent(true);
  if (leaving == entries_.end()) {
    if (!is_next(run_id)) return false;
    leaving = longest_silent(false);
    if (now - leaving->second.heard < silence) leaving = quietest(now - stay, waiting_.at(run_id));
  }
  if (leaving == entries_.end()) return false;
  drop(leaving);
  return true;
}

/// Counts a message of a run that waits for room. Whether no other was heard more often.
bool RunTable::is_next(std::int64_t run_id) {
  if (waiting_.size() >= max_waiting) {
    waiting_.clear();
    most_heard_ = 0;
  }
  const int heard = ++waiting_[run_id];
  most_heard_ = std::max(most_heard_, heard);
  return heard >= messages_to_enter && heard == most_heard_;
}

void RunTable::stop_waiting(std::int64_t run_id) {
  if (waiting_.erase(run_id) == 0) return;
  most_heard_ = 0;
  for (const auto& [id, heard] : waiting_) most_heard_ = std::max(most_heard_, heard);
}

/// Of the runs that ended, or of all.
RunTable::Iterator RunTable::longest_silent(bool ended) {
  auto found = entries_.end();
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
    if (ended && !entry->second.view.ended()) continue;
    if (found == entries_.end() || entry->second.heard < found->second.heard) found = entry;
  }
  return found;
}

/// Of the runs that entered before a time and have at most so many messages: the one with the fewest, of equal ones the
/// one that entered first. Above enough_messages all count as equal.
RunTable::Iterator RunTable::quietest(Clock::time_point entered_before, std::int64_t at_most) {
  const auto rank = [](const Entry& entry) {
    return std::pair(std::min(entry.view.received(), enough_messages), entry.entered);
  };
  auto found = entries_.end();
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
    if (entry->second.entered > entered_before || rank(entry->second).first > at_most) continue;
    if (found == entries_.end() || rank(entry->second) < rank(found->second)) found = entry;
  }
  return found;
}

void RunTable::drop(Iterator entry) {
  const RunView& view = entry->second.view;
  if (!view.ended() || entry->second.printed < view.received()) {
    dropped_ = sum_of_counts(dropped_, 1);
    last_dropped_ = entry->first;
  }
  lost_by_dropped_ = sum_of_counts(lost_by_dropped_, view.lost());
  entries_.erase(entry);
}

void RunTable::restart(std::int64_t run_id) {
  Entry& entry = entries_.at(run_id);
  lost_by_dropped_ = sum_of_counts(lost_by_dropped_, entry.view.lost());
  entry.view = {};
  entry.printed = 0;
}

std::int64_t RunTable::lost() const {
  std::int64_t sum = lost_by_dropped_;
  for (const auto& [run_id, entry] : entries_) sum = sum_of_counts(sum, entry.view.lost());
  return sum;
}

}  // namespace talus

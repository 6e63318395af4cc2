#pragma once
// What the messages have in common: a header, room for so many entries, and parts where a step needs several.

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lcmtypes/channels.h"

namespace talus {

/// Bytes that a message of fixed and counted fields has for the counted ones.
template <class Message>
inline constexpr std::size_t room = max_message_bytes - fingerprint_bytes - fixed_bytes(layout<Message>);

/// Texts come from scene files and error messages; a message must stay small whatever they hold.
inline std::string clipped(std::string_view text) { return std::string(text.substr(0, 1000)); }

/// Numbers the messages that one step was split into.
template <class Message>
std::vector<Message> numbered(std::vector<Message> messages) {
  for (std::size_t i = 0; i < messages.size(); ++i) {
    messages[i].part = static_cast<std::int32_t>(i);
    messages[i].parts = static_cast<std::int32_t>(messages.size());
  }
  return messages;
}

/// Gathers these messages: those with the same step and number of parts, from part 0 on in
/// order. What does not fit is left out, with all parts before it.
template <class Message>
class Parts {
 public:
  /// Whether `message` was the last one, so that all() has all parts.
  bool take(const Message& message) {
    if (message.part == 0 || complete_) parts_.clear();
    complete_ = false;
    const bool next = message.part == static_cast<std::int32_t>(parts_.size());
    const bool fits = parts_.empty() || (message.step == parts_[0].step && message.parts == parts_[0].parts);
    if (!next || !fits) {
      parts_.clear();
      return false;
    }
    parts_.push_back(message);
    complete_ = message.part + 1 == message.parts;
    return complete_;
  }

  const std::vector<Message>& all() const { return parts_; }

 private:
  std::vector<Message> parts_;
  bool complete_ = false;
};

// What range_fault() of a message checks:

template <class Message>
bool header_holds(const Message& m) {
  return m.step >= 0 && m.seq >= 0 && m.sim_time >= 0.0;
}

template <class Message>
bool parts_hold(const Message& m) {
  return m.part >= 0 && m.part < m.parts;
}

inline bool is_index_or_none(std::int32_t value) { return value >= -1; }

inline constexpr auto is_negative = [](auto value) { return value < 0; };

inline bool ascend(const std::vector<std::int32_t>& numbers) {
  return std::ranges::adjacent_find(numbers, std::greater_equal()) == numbers.end();
}

}  // namespace talus

#pragma once

#include <cstdint>
#include <vector>

namespace talus {

/// Gathers the messages that one step was split into: those with the same step and number of parts, from part 0 on in
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

}  // namespace talus

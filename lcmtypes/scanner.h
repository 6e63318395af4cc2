#pragma once

#include <cstdint>
#include <span>

#include "lcmtypes/channels.h"

namespace talus {

/// Walks over an encoded message without keeping anything, and fails for good when something does not fit.
class Scanner {
 public:
  explicit Scanner(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  bool failed() const { return failed_; }
  bool at_end() const { return !failed_ && rest_.empty(); }

  void skip(std::size_t bytes) {
    if (failed_ || bytes > rest_.size()) {
      failed_ = true;
    } else {
      rest_ = rest_.subspan(bytes);
    }
  }

  /// An int32_t that says how many follow; 0 after a failure.
  std::size_t count() {
    if (failed_ || rest_.size() < 4 || rest_[0] > 0x7F) {
      failed_ = true;
      return 0;
    }
    const std::size_t value = static_cast<std::size_t>(rest_[0]) << 24 | static_cast<std::size_t>(rest_[1]) << 16 |
                              static_cast<std::size_t>(rest_[2]) << 8 | rest_[3];
    skip(4);
    return value;
  }

  /// `number` entries of `bytes` each; both small enough not to overflow, since a count is below 2^31.
  void array(std::size_t number, std::size_t bytes) { skip(number * bytes); }

  /// A string: its length with the final zero byte, then its bytes.
  void text() {
    const std::size_t length = count();
    if (length == 0 || length > rest_.size() || rest_[length - 1] != 0) {
      failed_ = true;
    }
    skip(length);
  }

 private:
  std::span<const std::uint8_t> rest_;
  bool failed_ = false;
};

/// Walks over all of a message of the given type, fingerprint and checksum included.
template <class Message>
bool counts_fit(std::span<const std::uint8_t> bytes);

}  // namespace talus

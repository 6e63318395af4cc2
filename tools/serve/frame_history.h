#pragma once
// The frames of a run so far, for pages that come late or lag behind.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace talus {

/// Frames as blocks of bytes, each of which has a meaning only after those before it. Once they take more than
/// `most_bytes`, neighbours are merged until they take at most three quarters of that: the frames that are left lie
/// about evenly over the whole run. The first and the newest frame always stay.
class FrameHistory {
 public:
  /// Of two blocks that follow each other, one that does what both do.
  using Merge = std::function<std::string(std::string_view, std::string_view)>;

  FrameHistory(std::size_t most_bytes, Merge merge) : most_bytes_(most_bytes), merge_(std::move(merge)) {}

  /// Adds a frame after `step` steps; steps never decrease. Returns its number, which is larger than all before.
  /// `held`: numbers of frames that must stay: the last that some page was sent.
  std::int64_t add(std::int64_t step, std::string block, std::span<const std::int64_t> held);

  /// Blocks one after the other.
  struct Run {
    std::string bytes;
    std::int64_t frames = 0;
    std::int64_t last = -1;  // number of the last one
  };
  /// What follows frame `number` (-1: all), in one piece of at most `most_bytes`, of at least one frame if there is
  /// one.
  Run after(std::int64_t number, std::size_t most_bytes) const;

  /// The newest frame's number; -1: there is none.
  std::int64_t newest() const { return next_ - 1; }
  std::size_t size() const { return frames_.size(); }
  std::size_t bytes() const { return bytes_; }
  /// Steps that two neighbours lie apart at most where frames were merged; 0: none was.
  std::int64_t spacing() const { return spacing_; }

 private:
  struct Frame {
    std::int64_t number = 0;
    std::int64_t step = 0;
    std::string block;
  };
  static std::size_t room_of(const Frame& frame) { return sizeof(Frame) + frame.block.capacity(); }
  void thin(std::span<const std::int64_t> held);
  void merge_closer(std::span<const std::int64_t> held);

  std::size_t most_bytes_;
  Merge merge_;
  std::deque<Frame> frames_;  // by number and step
  std::size_t bytes_ = 0;
  std::int64_t next_ = 0;
  std::int64_t spacing_ = 0;
};

}  // namespace talus

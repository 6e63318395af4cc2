#include "tools/serve/frame_history.h"

#include <algorithm>
#include <utility>

namespace talus {

std::int64_t FrameHistory::add(std::int64_t step, std::string block, std::span<const std::int64_t> held) {
  block.shrink_to_fit();
  frames_.push_back({next_++, step, std::move(block)});
  bytes_ += room_of(frames_.back());
  if (bytes_ > most_bytes_ && frames_.size() > 2) thin(held);
  return next_ - 1;
}

/// First brings what came since the last time to the spacing of what lies before it.
void FrameHistory::thin(std::span<const std::int64_t> held) {
  const std::int64_t steps = frames_.back().step - frames_.front().step;
  if (spacing_ == 0) spacing_ = std::max<std::int64_t>(1, 2 * steps / static_cast<std::int64_t>(frames_.size() - 1));
  merge_closer(held);
  while (bytes_ > most_bytes_ / 4 * 3 && spacing_ <= steps) {
    spacing_ *= 2;
    merge_closer(held);
  }
}

/// Merges each frame whose neighbours lie no farther apart than the spacing with the one after it.
void FrameHistory::merge_closer(std::span<const std::int64_t> held) {
  std::deque<Frame> kept;
  for (Frame& frame : frames_) {
    const bool between = kept.size() > 1 && frame.step - kept[kept.size() - 2].step <= spacing_;
    if (between && std::ranges::find(held, kept.back().number) == held.end()) {
      std::string both = merge_(kept.back().block, frame.block);
      both.shrink_to_fit();
      kept.back() = {frame.number, frame.step, std::move(both)};
    } else {
      kept.push_back(std::move(frame));
    }
  }
  frames_ = std::move(kept);
  bytes_ = 0;
  for (const Frame& frame : frames_) bytes_ += room_of(frame);
}

FrameHistory::Run FrameHistory::after(std::int64_t number, std::size_t most_bytes) const {
  Run run;
  run.last = number;
  for (auto frame = std::ranges::upper_bound(frames_, number, {}, &Frame::number); frame != frames_.end(); ++frame) {
    if (run.frames > 0 && run.bytes.size() + frame->block.size() > most_bytes) break;
    run.bytes += frame->block;
    run.last = frame->number;
    ++run.frames;
  }
  return run;
}

}  // namespace talus

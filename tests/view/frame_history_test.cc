// The frames of a run that wait for pages that come late.

#include "tools/serve/frame_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace talus::frame_history_test {
namespace {

/// A block of this test is a list of letters; merged ones have the letters of both, and 1000 bytes as each.
constexpr std::size_t block_bytes = 1000;

std::string block_of(char letter) { return letter + std::string(block_bytes - 1, ' '); }

std::string letters(std::string_view block) {
  std::string found;
  std::ranges::copy_if(block, std::back_inserter(found), [](char letter) { return letter != ' '; });
  return found;
}

std::string merge(std::string_view a, std::string_view b) {
  std::string both = letters(a) + letters(b);
  both.resize(std::max(both.size(), block_bytes), ' ');
  return both;
}

char letter_of(int frame) { return static_cast<char>('a' + frame % 26); }

/// Steps per frame, and the letters of all frames.
std::string fill(FrameHistory& history, int frames, std::span<const std::int64_t> held = {}) {
  std::string all;
  for (int frame = 0; frame < frames; ++frame) {
    all += letter_of(frame);
    history.add(2 * frame, block_of(letter_of(frame)), held);
  }
  return all;
}

TEST(FrameHistory, GivesEachFrameOnceInOrderInPiecesOfTheSizeAskedFor) {
  FrameHistory history(1 << 20U, merge);
  const std::string all = fill(history, 10);
  EXPECT_EQ(letters(history.after(-1, 1 << 20U).bytes), all);
  std::string found;
  std::int64_t last = -1;
  for (int piece = 0; piece < 5; ++piece) {
    const FrameHistory::Run run = history.after(last, 2 * block_bytes);
    EXPECT_EQ(run.frames, 2);
    found += letters(run.bytes);
    last = run.last;
  }
  EXPECT_EQ(found, all);
  EXPECT_EQ(last, history.newest());
  EXPECT_EQ(history.after(last, 1).frames, 0);
  EXPECT_EQ(history.after(3, 1).frames, 1) << "at least one, however large";
  EXPECT_EQ(history.spacing(), 0);
}

TEST(FrameHistory, KeepsToItsMemoryAndLosesNothingThatABlockSays) {
  constexpr std::size_t most = 40 * block_bytes;
  FrameHistory history(most, merge);
  const std::string all = fill(history, 2000);
  EXPECT_LE(history.bytes(), most);
  EXPECT_GT(history.size(), 10U);
  const std::string kept = letters(history.after(-1, 1 << 30U).bytes);
  EXPECT_EQ(kept, all);
}

TEST(FrameHistory, LeavesFramesThatLieEvenlyOverTheWholeRunWithTheFirstAndTheLast) {
  FrameHistory history(40 * block_bytes, merge);
  fill(history, 1000);
  ASSERT_GT(history.spacing(), 0);
  std::int64_t last = history.after(-1, 1).last;
  EXPECT_EQ(last, 0) << "the first frame of the run";
  std::int64_t before = last;
  std::int64_t widest = 0;
  while (last < history.newest()) {
    last = history.after(last, 1).last;
    widest = std::max(widest, 2 * (last - before));
    before = last;
  }
  EXPECT_LE(widest, history.spacing());
  EXPECT_LT(history.spacing(), 2000 / 5) << "of 1998 steps, in at most 40 frames";
}

TEST(FrameHistory, MergesNoFrameThatAPageHasAlready) {
  FrameHistory history(40 * block_bytes, merge);
  const std::vector<std::int64_t> held = {17, 501};
  const std::string all = fill(history, 2000, held);
  for (const std::int64_t number : held)
    EXPECT_EQ(letters(history.after(number, 1 << 30U).bytes), all.substr(number + 1)) << "after frame " << number;
}

}  // namespace
}  // namespace talus::frame_history_test

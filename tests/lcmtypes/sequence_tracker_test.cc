#include "lcmtypes/sequence_tracker.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

namespace talus::sequence_tracker_test {
namespace {

TEST(SequenceTracker, CountsNothingWhenAllCome) {
  SequenceTracker tracker;
  for (int number = 7; number < 300; ++number) EXPECT_TRUE(tracker.see(number));
  EXPECT_EQ(tracker.lost(), 0);
  EXPECT_EQ(tracker.received(), 293);
}

TEST(SequenceTracker, CountsGapsAndTakesThemBackWhenLateOnesCome) {
  SequenceTracker tracker;
  tracker.see(0);
  tracker.see(4);
  EXPECT_EQ(tracker.lost(), 3);
  EXPECT_FALSE(tracker.see(2));
  EXPECT_EQ(tracker.lost(), 2);
  EXPECT_FALSE(tracker.see(2));  // a duplicate
  EXPECT_EQ(tracker.lost(), 2);
}

TEST(SequenceTracker, SeesThatTheLastOnesAreMissing) {
  SequenceTracker tracker;
  tracker.expect(3);  // joined late: three were sent before
  EXPECT_EQ(tracker.lost(), 0);
  tracker.expect(5);
  EXPECT_EQ(tracker.lost(), 2);
  EXPECT_FALSE(tracker.see(1));
  EXPECT_EQ(tracker.lost(), 2);
}

TEST(SequenceTracker, HoldsAtTheLargestNumbers) {
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  SequenceTracker tracker;
  EXPECT_TRUE(tracker.see(0));
  EXPECT_TRUE(tracker.see(largest));
  EXPECT_FALSE(tracker.see(largest));
  tracker.expect(largest);
  EXPECT_GT(tracker.lost(), largest - 5);
}

TEST(SequenceTracker, LosesNothingWhereTheFirstNumberIsTheLargest) {
  SequenceTracker tracker;
  for (int copy = 0; copy < 3; ++copy) tracker.see(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(tracker.lost(), 0);
  EXPECT_EQ(tracker.received(), 1);
}

// Numbers arrive at most 20 places from where they belong, some never, some twice.
RC_GTEST_PROP(SequenceTracker, CountsExactlyUnderReordering, ()) {
  std::vector<std::pair<int, int>> arrivals;  // when, number
  std::set<int> sent;
  const int number = *rc::gen::inRange(1, 400);
  for (int i = 0; i < number; ++i) {
    const int copies = *rc::gen::element(0, 1, 1, 1, 2);
    for (int copy = 0; copy < copies; ++copy) arrivals.emplace_back(i + *rc::gen::inRange(0, 20), i);
    if (copies > 0) sent.insert(i);
  }
  std::stable_sort(arrivals.begin(), arrivals.end(), [](auto a, auto b) { return a.first < b.first; });
  SequenceTracker tracker;
  tracker.expect(0);
  for (const auto& arrival : arrivals) tracker.see(arrival.second);
  tracker.expect(number);
  RC_ASSERT(tracker.received() == static_cast<std::int64_t>(sent.size()));
  RC_ASSERT(tracker.lost() == number - static_cast<std::int64_t>(sent.size()));
}

}  // namespace
}  // namespace talus::sequence_tracker_test

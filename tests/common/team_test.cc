#include "common/world/team.h"

#include <gtest/gtest.h>

#include <numeric>
#include <thread>
#include <vector>

namespace talus::team_test {
namespace {

// Also where there are more threads than processors.
TEST(TeamTest, EachMemberDoesEachTaskOnce) {
  for (const int threads : {1, 2, 7}) {
    Team team(threads);
    std::vector<int> done(threads, 0);
    for (int repeat = 0; repeat < 100; ++repeat) team.run([&](int member) { ++done[member]; });
    EXPECT_EQ(done, std::vector<int>(threads, 100)) << threads << " threads";
  }
}

TEST(TeamTest, TheCallingThreadIsTheFirstMember) {
  Team team(3);
  std::vector<std::thread::id> ids(3);
  team.run([&](int member) { ids[member] = std::this_thread::get_id(); });
  EXPECT_EQ(ids[0], std::this_thread::get_id());
  EXPECT_NE(ids[1], ids[0]);
  EXPECT_NE(ids[2], ids[1]);
}

// Each adds what all wrote before the last meeting: powers of the number of members.
TEST(TeamTest, WhatWasWrittenBeforeAMeetingIsSeenByAllAfterIt) {
  constexpr int threads = 4;
  constexpr int meetings = 20;
  Team team(threads);
  std::vector<std::vector<long long>> values(meetings + 1, std::vector<long long>(threads, 1));
  team.run([&](int member) {
    for (int i = 0; i < meetings; ++i) {
      values[i + 1][member] = std::accumulate(values[i].begin(), values[i].end(), 0LL);
      team.meet();
    }
  });
  for (const long long value : values.back()) EXPECT_EQ(value, 1LL << (2 * meetings));
}

TEST(TeamTest, DividesThingsIntoPartsThatMissNoneAndRepeatNone) {
  for (const int count : {0, 1, 64, 1000}) {
    Team team(3);
    std::vector<int> visits(count, 0);
    team.divide(count, [&](int first, int last, int /*member*/) {
      for (int i = first; i < last; ++i) ++visits[i];
    });
    EXPECT_EQ(visits, std::vector<int>(count, 1));
  }
}

TEST(TeamTest, SharesOfAllMembersAreAllThingsInOrder) {
  int next = 0;
  for (int member = 0; member < 3; ++member) {
    const Share share = share_of(8, member, 3);
    EXPECT_EQ(share.first, next);
    next = share.last;
  }
  EXPECT_EQ(next, 8);
}

}  // namespace
}  // namespace talus::team_test

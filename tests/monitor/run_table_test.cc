#include "tools/monitor/run_table.h"

#include <gtest/gtest.h>

namespace talus::run_table_test {
namespace {

using Time = RunTable::Clock::time_point;
using std::chrono::milliseconds;

/// A table and its time, with runs that send statistics.
struct Network {
  RunTable table;
  Time now{};
  std::map<std::int64_t, std::int64_t> sent;

  void send(std::int64_t run_id) {
    talus_lcm::talus_stats message{};
    message.run_id = run_id;
    message.seq = sent[run_id]++;
    if (RunTable::Entry* entry = table.find(run_id, now)) entry->view.take(message);
  }
  bool shows(std::int64_t run_id) const { return table.entries().contains(run_id); }
};

constexpr std::int64_t real = 1'000'000'000;
constexpr auto full = static_cast<std::int64_t>(RunTable::max_runs);

TEST(RunTable, DropsTheLongestSilentRunWhenFull) {
  Network network;
  for (std::int64_t id = 0; id < full; ++id) {
    network.now += milliseconds(10);
    network.send(id);
  }
  network.now += milliseconds(2000);
  network.send(0);
  for (int i = 0; i < RunTable::messages_to_enter; ++i) network.send(real);
  EXPECT_TRUE(network.shows(real));
  EXPECT_TRUE(network.shows(0));
  EXPECT_FALSE(network.shows(1));
  EXPECT_EQ(network.table.dropped(), 1);
  EXPECT_EQ(network.table.last_dropped(), 1);
}

TEST(RunTable, DropsAnEndedRunFirstAndWithoutAFaultOncePrinted) {
  Network network;
  for (std::int64_t id = 0; id < full; ++id) network.send(id);
  talus_lcm::talus_run end{};
  end.phase = talus_lcm::talus_run::END;
  RunTable::Entry& ended = network.table.entries().at(7);
  ended.view.take(end);
  ended.printed = ended.view.received();
  network.send(real);
  EXPECT_TRUE(network.shows(real));
  EXPECT_FALSE(network.shows(7));
  EXPECT_EQ(network.table.dropped(), 0);
}

TEST(RunTable, ShowsARunThatBeginsWhileAFullTableOfForgedRunsSends) {
  Network network;
  int shown = 0;
  for (int step = 0; step < 20'000; ++step) {  // 20 s
    network.now += milliseconds(1);
    for (int i = 0; i < 4; ++i) network.send((4 * step + i) % full);
    if (step > 4000 && step % 16 == 0) network.send(real);
    if (step > 4000 && step % 1000 == 0) shown += network.shows(real) ? 1 : 0;
  }
  EXPECT_GE(shown, 13) << "of 15 seconds";
  EXPECT_GT(network.table.dropped(), 0);
}

TEST(RunTable, ShowsARunAmongInventedOnesThatSendAFewMessagesEach) {
  Network network;
  std::int64_t invented = 0;
  int shown = 0;
  for (int step = 0; step < 10'000; ++step) {  // 10 s
    network.now += milliseconds(1);
    for (int i = 0; i < 10; ++i) network.send(invented++ / 4);
    if (step >= 100 && step % 16 == 0) network.send(real);
    if (step >= 5000 && step % 1000 == 0) shown += network.shows(real) ? 1 : 0;
  }
  EXPECT_EQ(shown, 5) << "of 5 seconds";
}

TEST(RunTable, ShowsARunInAFloodOfInventedRunsWithOneMessageEach) {
  Network network;
  std::int64_t invented = 0;
  int shown = 0;
  for (int step = 0; step < 10'000; ++step) {  // 10 s
    network.now += milliseconds(1);
    for (int i = 0; i < 10; ++i) network.send(invented++);
    if (step >= 100 && step % 16 == 0) network.send(real);
    if (step >= 5000 && step % 1000 == 0) shown += network.shows(real) ? 1 : 0;
  }
  EXPECT_EQ(shown, 5) << "of 5 seconds";
  EXPECT_GT(network.table.unplaced(), 0);
  EXPECT_LE(network.table.entries().size(), RunTable::max_runs);
}

}  // namespace
}  // namespace talus::run_table_test

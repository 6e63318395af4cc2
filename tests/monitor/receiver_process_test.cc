#include "tools/monitor/receiver_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <string>

namespace talus::receiver_process_test {
namespace {

using std::chrono::milliseconds;
using Clock = ReceiverProcess::Clock;

void wait_forever() {
  for (;;) pause();
}

/// What the datagrams of the next `time` say.
std::vector<std::string> heard(ReceiverProcess& receiver, milliseconds time) {
  std::vector<std::string> texts;
  for (const auto end = Clock::now() + time; Clock::now() < end;)
    if (const auto datagram = receiver.next(milliseconds(10)))
      texts.emplace_back(datagram->bytes.begin(), datagram->bytes.end());
  return texts;
}

TEST(ReceiverProcess, HandsOverWhatItsChildSends) {
  ReceiverProcess receiver([](const DatagramSender& sender) {
    sender.alive();
    sender.send(Channel::stats, "hello", 5);
    sender.send(Channel::piles, nullptr, 0);
    wait_forever();
  });
  EXPECT_EQ(heard(receiver, milliseconds(300)), (std::vector<std::string>{"hello", ""}));
  EXPECT_EQ(receiver.crashes(), 0);
}

TEST(ReceiverProcess, CutsWhatIsTooLongByAllButOneByte) {
  ReceiverProcess receiver([](const DatagramSender& sender) {
    const std::string text(100'000, 'x');
    sender.send(Channel::stats, text.data(), text.size());
    wait_forever();
  });
  const auto texts = heard(receiver, milliseconds(300));
  ASSERT_EQ(texts.size(), 1U);
  EXPECT_EQ(texts[0].size(), max_message_bytes + 1);
}

TEST(ReceiverProcess, StartsAgainAfterACrashWithinASecond) {
  ReceiverProcess receiver([](const DatagramSender& sender) {
    const std::string pid = std::to_string(getpid());
    sender.send(Channel::run, pid.data(), pid.size());
    wait_forever();
  });
  const pid_t first = receiver.pid();
  EXPECT_EQ(heard(receiver, milliseconds(200)), std::vector{std::to_string(first)});
  kill(first, SIGKILL);
  const auto texts = heard(receiver, milliseconds(900));
  EXPECT_EQ(texts, std::vector{std::to_string(receiver.pid())});
  EXPECT_NE(receiver.pid(), first);
  EXPECT_EQ(receiver.crashes(), 1);
  EXPECT_EQ(receiver.last_crash(), "signal 9 (Killed)");
}

TEST(ReceiverProcess, SlowsDownWhenTheChildCrashesAtEachStart) {
  ReceiverProcess receiver([](const DatagramSender&) { _exit(3); });
  EXPECT_TRUE(heard(receiver, milliseconds(2000)).empty());
  EXPECT_GE(receiver.crashes(), 4);
  EXPECT_LE(receiver.crashes(), 7) << "after 0, 50, 150, 350, 750, 1250, 1750 ms";
  EXPECT_EQ(receiver.last_crash(), "exit code 3");
  EXPECT_EQ(receiver.restart_delay(), ReceiverProcess::longest_delay);
}

TEST(ReceiverProcess, CountsAnExceptionOfTheChildAsACrash) {
  ReceiverProcess receiver([](const DatagramSender&) { throw std::runtime_error("expected by a test"); });
  heard(receiver, milliseconds(100));
  EXPECT_GE(receiver.crashes(), 1);
  EXPECT_EQ(receiver.last_crash(), "exit code 1");
}

TEST(ReceiverProcess, ReplacesAChildThatStandsStill) {
  ReceiverProcess receiver([](const DatagramSender& sender) {
    sender.alive();
    wait_forever();
  });
  heard(receiver, ReceiverProcess::stall_limit + milliseconds(500));
  EXPECT_EQ(receiver.crashes(), 1);
  EXPECT_EQ(receiver.last_crash(), "no sign of life for 5 s");
}

TEST(ReceiverProcess, LeavesNoChildBehind) {
  pid_t child = 0;
  {
    const ReceiverProcess receiver([](const DatagramSender&) { wait_forever(); });
    child = receiver.pid();
  }
  EXPECT_NE(kill(child, 0), 0);
}

}  // namespace
}  // namespace talus::receiver_process_test

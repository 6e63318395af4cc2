// What gets through when more is queued than can be sent.

#include "lcmtypes/send_queue.h"

#include <gtest/gtest.h>

#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <string>

namespace talus::send_queue_test {
namespace {

/// Counts the packets by channel.
class Counter {
 public:
  explicit Counter(lcm::LCM& lcm) { lcm.subscribe("TALUS_.*", &Counter::hear, this); }
  int of(Channel channel) const {
    const auto found = heard_.find(name_of(channel));
    return found == heard_.end() ? 0 : found->second;
  }

 private:
  void hear(const lcm::ReceiveBuffer*, const std::string& channel) { ++heard_[channel]; }
  std::map<std::string, int> heard_;
};

TEST(SendQueue, AtTheEndSaysHowItWentThoughMoreIsQueuedThanPatienceLasts) {
  lcm::LCM lcm("memq://");
  Counter counter(lcm);
  SendQueue queue(lcm, 8U << 20U);
  constexpr int many = 3000;  // at most eight are sent in 0.1 ms, so these take 0.04 s or longer
  for (int i = 0; i < many; ++i) queue.push({.channel = Channel::piles, .bytes = {1, 2, 3}});
  queue.push({.channel = Channel::stats, .bytes = {4}});
  queue.push({.channel = Channel::run, .bytes = {5}});
  queue.close(std::chrono::milliseconds(10));
  while (lcm.handleTimeout(50) > 0) {
  }
  EXPECT_EQ(counter.of(Channel::stats), 1);
  EXPECT_EQ(counter.of(Channel::run), 1);
  EXPECT_LT(counter.of(Channel::piles), many);
  EXPECT_EQ(counter.of(Channel::piles) + queue.dropped(), many);
}

}  // namespace
}  // namespace talus::send_queue_test

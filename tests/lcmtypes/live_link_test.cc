#include "lcmtypes/live_link.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>

#include "lcmtypes/publisher.h"
#include "tests/lcmtypes/still_run.h"

namespace talus::live_link_test {
namespace {

TEST(LiveLink, StaysOnThisMachineUnlessAskedOtherwise) {
  for (const char* local : {"udpm://", "udpm://239.255.76.67:7667", "udpm://239.255.76.67:7667?ttl=0", "memq://",
                            "udpm://?recv_buf_size=1000&ttl=0", "file:///tmp/x?mode=w"}) {
    EXPECT_NO_THROW(require_local(local)) << local;
  }
  for (const char* remote : {"udpm://239.255.76.67:7667?ttl=1", "udpm://?ttl=0&ttl=1", "udpm://?ttl=00x",
                             "udpm://?ttl=", "mpudpm://?recv_buf_size=1&ttl=255"}) {
    EXPECT_THROW(require_local(remote), std::invalid_argument) << remote;
  }
}

TEST(LiveLink, TakesTheAddressGivenThenTheVariableThenTheDefault) {
  setenv("LCM_DEFAULT_URL", "udpm://239.255.76.67:7001?ttl=0", 1);
  EXPECT_EQ(effective_url("memq://"), "memq://");
  EXPECT_EQ(effective_url(""), "udpm://239.255.76.67:7001?ttl=0");
  unsetenv("LCM_DEFAULT_URL");
  EXPECT_EQ(effective_url(""), "udpm://239.255.76.67:7667?ttl=0");
}

TEST(LiveLink, ReceivesWithTheLargestBufferThatTheKernelAllowsUnlessTheAddressSaysAnother) {
  unsetenv("LCM_DEFAULT_URL");
  const std::string url = receiving_url("");
  const std::string begin = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=";
  ASSERT_TRUE(url.starts_with(begin)) << url;
  EXPECT_GE(std::stoi(url.substr(begin.size())), 1 << 16);
  EXPECT_TRUE(receiving_url("udpm://").starts_with("udpm://?recv_buf_size="));
  EXPECT_EQ(receiving_url("udpm://?recv_buf_size=5000"), "udpm://?recv_buf_size=5000");
  EXPECT_EQ(receiving_url("memq://"), "memq://");
}

TEST(LiveLink, RefusesWhatIsNoAddress) {
  for (const char* good : {"udpm://", "udpm://239.255.76.67:7667?ttl=0", "udpm://224.0.0.1", "mpudpm://?ttl=0",
                           "memq://", "udpm://?recv_buf_size=5", "file:///tmp/x?mode=w", "tcpq://localhost:7700"}) {
    EXPECT_NO_THROW(check_url(good)) << good;
  }
  for (const char* bad : {"nonsense", "udpm:/", "UDPM://", "http://example.org", "udpm://nowhere",
                          "udpm://10.0.0.1:7667", "udpm://239.255.76.67:0", "udpm://239.255.76.67:7667x",
                          "udpm://239.255.76.67:99999", "udpm://239.255.76.67:"}) {
    EXPECT_THROW(check_url(bad), std::invalid_argument) << bad;
  }
}

TEST(LiveLink, SaysWhatItCannotOpen) {
  EXPECT_NE(open_live_link("nosuch://").problem, "");
  EXPECT_EQ(open_live_link("memq://").problem, "");
}

TEST(Publisher, RefusesAnAddressThatLeavesTheMachine) {
  const Scene<2> scene = still_scene<2>();
  EXPECT_THROW(Publisher<2>(run_info(scene, "still", "none"), {.url = "udpm://239.255.76.67:7667?ttl=1"}),
               std::invalid_argument);
}

TEST(Publisher, DoesNothingWithoutAWayIntoTheNetwork) {
  const Scene<2> scene = still_scene<2>();
  Publisher<2> publisher(run_info(scene, "still", "none"), {.url = "nosuch://"});
  EXPECT_FALSE(publisher.connected());
  const auto run = still_run<2>(scene, 3);
  run->add_observer(publisher);
  for (int step = 0; step < 10; ++step) run->step();
  run->end("finished");
  EXPECT_EQ(publisher.dropped(), 0);
}

}  // namespace
}  // namespace talus::live_link_test

#include "tools/monitor/monitor.h"

#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "lcmtypes/publisher.h"
#include "tests/lcmtypes/still_run.h"

namespace talus::monitor_test {
namespace {

using Json = nlohmann::json;

const std::atomic<bool> go_on = false;

/// Publishes a run on `lcm` while a monitor with these parameters listens; what the monitor printed and returned.
std::pair<std::string, int> watch(const MonitorParams& params, int steps) {
  lcm::LCM lcm("memq://");
  const Scene<2> scene = still_scene<2>();
  std::thread simulation([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // the monitor is there first
    Publisher<2> publisher(run_info(scene, "still", "none"), scene, {.piles_rate = 0.0}, lcm);
    const auto run = still_run<2>(scene, 12);
    run->add_observer(publisher);
    for (int step = 0; step < steps; ++step) run->step();
    run->end("finished");
  });
  std::ostringstream out;
  const int code = monitor(lcm, params, out, go_on);
  simulation.join();
  return {out.str(), code};
}

TEST(Monitor, ShowsARunInALineForPeople) {
  const auto [text, code] = watch({.seconds = 1.0, .interval = 0.7}, 30);
  EXPECT_EQ(code, 0);
  EXPECT_NE(text.find("still none adaptive"), std::string::npos) << text;
  EXPECT_NE(text.find("step 30"), std::string::npos) << text;
  EXPECT_NE(text.find(" layer"), std::string::npos) << text;
  EXPECT_NE(text.find("lost 0"), std::string::npos) << text;
  EXPECT_NE(text.find("ended: finished"), std::string::npos) << text;
}

TEST(Monitor, GivesJsonForPrograms) {
  const auto [text, code] = watch({.seconds = 1.0, .interval = 0.7, .json = true, .fail_on_loss = true}, 30);
  EXPECT_EQ(code, 0);
  const Json run = Json::parse(text.substr(0, text.find('\n')));
  EXPECT_EQ(run["scene"], "still");
  EXPECT_EQ(run["step"], 30);
  EXPECT_EQ(run["phase"], "end");
  EXPECT_EQ(run["awake"].get<int>() + run["asleep"].get<int>(), 12);
  EXPECT_EQ(run["slept"], 4 * 12);  // steps 4, 12, 20, 28
  EXPECT_EQ(run["woken"], 3 * 12);
  EXPECT_EQ(run["lost"]["TALUS_PILES"], 0);
  EXPECT_EQ(run["piles"].size(), 1U);
  EXPECT_EQ(run["piles"][0]["density"].size(), run["piles"][0]["layers"].get<std::size_t>());
}

TEST(Monitor, FailsOnRequestWhenItHeardNothing) {
  lcm::LCM lcm("memq://");
  std::ostringstream out;
  EXPECT_EQ(monitor(lcm, {.seconds = 0.1}, out, go_on), 0);
  EXPECT_EQ(monitor(lcm, {.seconds = 0.1, .fail_on_loss = true}, out, go_on), 1);
}

TEST(Monitor, StopsWhenAsked) {
  lcm::LCM lcm("memq://");
  std::ostringstream out;
  const std::atomic<bool> stop = true;
  EXPECT_EQ(monitor(lcm, {}, out, stop), 0);
}

TEST(Monitor, RefusesBadParameters) {
  lcm::LCM lcm("memq://");
  std::ostringstream out;
  EXPECT_THROW(monitor(lcm, {.seconds = 0.0}, out, go_on), std::invalid_argument);
  EXPECT_THROW(monitor(lcm, {.interval = -1.0}, out, go_on), std::invalid_argument);
}

}  // namespace
}  // namespace talus::monitor_test

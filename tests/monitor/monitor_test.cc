#include "tools/monitor/monitor.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "lcmtypes/publisher.h"
#include "tests/common/documented_names.h"
#include "tests/common/temporary_folder.h"
#include "tests/lcmtypes/still_run.h"
#include "tools/monitor/json_view.h"
#include "tools/monitor/receive.h"
#include "tools/monitor/run_view.h"

namespace talus::monitor_test {
namespace {

using Json = nlohmann::json;

/// Publishes a run of so many steps and receives it.
void receive_run(const DatagramSender& sender, int steps) {
  lcm::LCM lcm("memq://");
  const Scene<2> scene = still_scene<2>();
  std::thread simulation([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // the receiver is there first
    Publisher<2> publisher(run_info(scene, "still", "none"), {.piles_rate = 0.0}, lcm);
    const auto run = still_run<2>(scene, 12);
    run->add_observer(publisher);
    for (int step = 0; step < steps; ++step) run->step();
    run->end("finished");
  });
  receive(lcm, all_channels, sender);
}

void receive_nothing(const DatagramSender&) {
  for (;;) pause();
}

/// What a monitor printed and returned.
std::pair<std::string, int> watch(const MonitorParams& params, const ReceiverProcess::Body& body, bool stop = false) {
  ReceiverProcess receiver(body);
  std::ostringstream out;
  const int code = monitor(receiver, params, out, [stop] { return stop; });
  return {out.str(), code};
}

std::pair<std::string, int> watch(const MonitorParams& params, int steps) {
  return watch(params, [=](const DatagramSender& sender) { receive_run(sender, steps); });
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

TEST(Monitor, WritesTheKeysThatAreDocumented) {
  const auto [text, code] = watch({.seconds = 1.0, .interval = 0.7, .json = true}, 30);
  Names keys;
  collect(Json::parse(text.substr(0, text.find('\n'))), "", keys);
  collect(Json::parse(json_line(Faults{})), "", keys);
  Names expected = documented("talus monitor --json");
  std::erase_if(expected, [](const std::string& key) { return key.starts_with("warnings[]."); });  // of a bad run only
  EXPECT_EQ(missing(keys, expected), "") << "written, but not documented";
  EXPECT_EQ(missing(expected, keys), "") << "documented, but not written";
}

TEST(Monitor, FailsOnRequestWhenItHeardNothing) {
  EXPECT_EQ(watch({.seconds = 0.1}, receive_nothing).second, 0);
  EXPECT_EQ(watch({.seconds = 0.1, .fail_on_loss = true}, receive_nothing).second, 1);
}

TEST(Monitor, StopsWhenAsked) { EXPECT_EQ(watch({}, receive_nothing, true).second, 0); }

TEST(Monitor, RefusesBadParameters) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double seconds : {0.0, -1.0, nan})
    EXPECT_THROW(watch({.seconds = seconds}, receive_nothing), std::invalid_argument) << seconds;
  for (const double interval : {0.0, -1.0, nan, 1e300, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(watch({.interval = interval}, receive_nothing), std::invalid_argument) << interval;
}

/// Sends one message of a run, dies at once in the first process, and later in none.
void crash_once(const DatagramSender& sender, const std::string& mark) {
  const bool first = access(mark.c_str(), F_OK) != 0;
  std::ofstream(mark) << "was here";
  MessageEncoder encoder(42);
  talus_lcm::talus_stats stats{};
  const Packet packet = encoder.encode(stats, {});
  sender.send(packet.channel, packet.bytes.data(), packet.bytes.size());
  if (first) std::raise(SIGKILL);
  receive_nothing(sender);
}

TEST(Monitor, GoesOnAfterACrashOfItsReceiverAndShowsIt) {
  for (const bool json : {false, true}) {
    const TemporaryFolder folder;
    const auto [text, code] = watch({.seconds = 1.0, .interval = 0.4, .json = json, .fail_on_loss = true},
                                    [&](const DatagramSender& sender) { crash_once(sender, folder / "mark"); });
    EXPECT_EQ(code, 1);
    EXPECT_NE(text.find("0000002a"), std::string::npos) << text;
    EXPECT_NE(text.find("signal 9 (Killed)"), std::string::npos) << text;
    EXPECT_NE(text.find(json ? R"("receiver_crashes":1)" : "receiver crashed 1 times"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace talus::monitor_test

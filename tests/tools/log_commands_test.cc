// `talus info` on records: numbers, messages, repair.

#ifdef TALUS_LCM

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/common/documented_names.h"
#include "tests/process/process.h"

namespace talus::log_commands_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class LogCommand : public testing::Test {
 protected:
  /// A pour in the folder run.
  void SetUp() override {
    const Outcome outcome =
        talus_command("run drop_in_a_pile_2d --no-telemetry --set run.frames=300 --out " + (folder_ / "run"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  /// Flips a bit of a message of poses in the middle of the record of the folder hurt, a copy of run.
  void hurt_a_copy() {
    fs::copy(folder_.path() / "run", folder_.path() / "hurt");
    std::string log = contents(folder_.path() / "run" / "run.lcm");
    const std::size_t at = log.find("TALUS_BODIES", log.size() / 2) + 60;
    log[at] = static_cast<char>(log[at] ^ 1);
    std::ofstream(folder_.path() / "hurt" / "run.lcm", std::ios::binary) << log;
  }

  Json info(const std::string& run) {
    const Outcome outcome = talus_command("info --json " + (folder_ / run));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out);
  }

  std::int64_t messages(const Json& info, const std::string& channel) {
    for (const Json& each : info["channels"])
      if (each["name"] == channel) return each["messages"];
    return 0;
  }

  TemporaryFolder folder_;
};

TEST_F(LogCommand, InfoCountsWhatTheRunWrote) {
  const Json json = info("run");
  EXPECT_EQ(json["frames"], 300);
  EXPECT_EQ(json["reason"], "finished");
  EXPECT_EQ(json["end_s"], 10.0);
  EXPECT_EQ(json["damaged_bytes"], 0);
  for (const Json& channel : json["channels"]) EXPECT_EQ(channel["missing"], 0) << channel["name"];
  EXPECT_EQ(messages(json, "TALUS_STATS"), 301) << "each frame, and the end";
}

TEST_F(LogCommand, InfoWritesTheKeysThatAreDocumented) {
  record_with_event(folder_ / "event");
  Names keys;
  collect(info("event"), "", keys);
  expect_documented(keys, "talus info --json");
}

TEST_F(LogCommand, InfoShowsOneDamagedFrame) {
  hurt_a_copy();
  const Json json = info("hurt");
  EXPECT_EQ(json["frames"], 299);
  EXPECT_EQ(json["damaged_places"], 1);
  EXPECT_GT(json["damaged_bytes"], 0);
}

TEST_F(LogCommand, InfoPrintsEachMessageOfAChannelAsJson) {
  const Outcome outcome = talus_command("info --messages --channel TALUS_SLEEP " + (folder_ / "run"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::int64_t slept = 0;
  for (std::string line; std::getline(lines, line);) {
    const Json json = Json::parse(line);
    EXPECT_EQ(json["channel"], "TALUS_SLEEP");
    for (const Json& woke : json["message"]["woke"]) slept += woke.get<bool>() ? 0 : 1;
  }
  EXPECT_EQ(slept, Json::parse(contents(folder_.path() / "run" / "summary.json"))["slept_events"]);
}

TEST_F(LogCommand, RepairLeavesOutTheDamagedMessageOnly) {
  hurt_a_copy();
  ASSERT_EQ(talus_command("info --repair " + (folder_ / "hurt") + " --out " + (folder_ / "whole")).exit_code, 0);
  const Json before = info("run");
  const Json after = info("whole");
  EXPECT_EQ(after["damaged_bytes"], 0);
  for (const Json& channel : before["channels"]) {
    const std::string name = channel["name"];
    EXPECT_EQ(messages(after, name), messages(before, name) - (name == "TALUS_BODIES" ? 1 : 0)) << name;
  }
  EXPECT_EQ(talus_command("replay " + (folder_ / "whole") + " --out " + (folder_ / "a.html")).exit_code, 0);
}

TEST_F(LogCommand, TakesAForeignEventLog) {
  std::string event("\xED\xA1\xDA\x01", 4);
  event += std::string(16, '\0') + std::string("\0\0\0\5\0\0\0\3HELLOabc", 16);
  std::ofstream(folder_.path() / "foreign.lcm", std::ios::binary) << event << event;
  EXPECT_EQ(messages(info("foreign.lcm"), "HELLO"), 2);
  EXPECT_EQ(talus_command("info --messages " + (folder_ / "foreign.lcm")).exit_code, 0);
  EXPECT_EQ(talus_command("info --repair " + (folder_ / "foreign.lcm") + " --out " + (folder_ / "copy")).exit_code, 0);
  EXPECT_EQ(contents(folder_.path() / "copy" / "run.lcm").size(), 2 * event.size());
}

TEST_F(LogCommand, RefusesWhatIsNoRecordOptionsThatDoNotFitAndAFolderThatIsThere) {
  for (const char* command : {"info", "info --messages", "info --repair --out new"}) {
    const Outcome outcome = talus_command(fmt::format("{} {}", command, folder_ / "nothing"));
    EXPECT_EQ(outcome.exit_code, 2) << command;
  }
  for (const char* options :
       {"--repair", "--out new", "--channel TALUS_RUN", "--messages --json", "--repair --messages --out new"}) {
    const Outcome outcome = talus_command(fmt::format("info {} {}", folder_ / "run", options));
    EXPECT_EQ(outcome.exit_code, 2) << options;
  }
  const Outcome there = talus_command("info --repair " + (folder_ / "run") + " --out " + (folder_ / "run"));
  EXPECT_EQ(there.exit_code, 2);
  EXPECT_NE(there.err.find("must not exist yet"), std::string::npos) << there.err;
}

}  // namespace
}  // namespace talus::log_commands_test

#endif

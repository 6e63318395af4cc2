// Events of a scene in its record and in what is made from that.

#ifdef TALUS_LCM

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/common/temporary_folder.h"
#include "tests/process/process.h"

namespace talus::event_commands_test {
namespace {

using Json = nlohmann::json;

/// Discs on a shelf: an event removes a disc, one the shelf, and one halves gravity.
class EventCommands : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_.path() / "scene.toml")
        << "title = \"shelf\"\ndimension = 2\nshape.disc = {kind = \"ball\", radius = 0.5, colour = \"blue\"}\n"
           "run = {frames = 150}\nbody = [{position = [-1.1, 2.5], repeat = [3, 1], step = [1.1, 0]}]\n"
           "obstacle = [{kind = \"box\", size = [6, 1], position = [0, 1.5], name = \"shelf\"}]\n"
           "event = [{time = 1, do = \"remove\", body = 1}, {time = 2, do = \"remove\", obstacle = \"shelf\"},\n"
           "         {time = 4, do = \"gravity\", gravity = [0, -5]}]\n";
    const Outcome outcome = talus_command("run " + (folder_ / "scene.toml") + " --no-telemetry --out " + run());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  std::string run() const { return folder_ / "run"; }

  TemporaryFolder folder_;
};

TEST_F(EventCommands, TheRecordHasEachEventAndInfoListsIt) {
  const Outcome outcome = talus_command("info --json " + run());
  const Json events = Json::parse(outcome.out)["runs"][0]["events"];
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0]["text"], "remove some bodies");
  EXPECT_EQ(events[0]["step"], 61);
  EXPECT_EQ(events[1]["text"], "remove obstacle shelf");
  EXPECT_EQ(events[2]["text"], "gravity [0.0, -5.0]");
  EXPECT_NE(talus_command("info " + run()).out.find("event 1 before step 121: remove obstacle shelf"),
            std::string::npos);
}

TEST_F(EventCommands, ARemovedBodyIsGoneFromTheNextFrameOn) {
  const Outcome outcome = talus_command("export --out " + (folder_ / "run.csv") + " " + run());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::ifstream rows(folder_.path() / "run.csv");
  std::int64_t last_of_removed = 0;
  std::int64_t last_of_other = 0;
  for (std::string row; std::getline(rows, row);) {
    std::istringstream cells(row);
    std::string step;
    std::string time;
    std::string body;
    std::getline(std::getline(std::getline(cells, step, ','), time, ','), body, ',');
    if (body == "1") last_of_removed = std::stoll(step);
    if (body == "0") last_of_other = std::stoll(step);
  }
  EXPECT_EQ(last_of_removed, 60);
  EXPECT_EQ(last_of_other, 300);
}

TEST_F(EventCommands, ARemovedBodyDoesNotCountAsAsleep) {
  const Outcome outcome =
      talus_command("run " + (folder_ / "scene.toml") + " --policy full --no-telemetry --out " + (folder_ / "full"));
  EXPECT_NE(outcome.out.find("3 bodies, 0 asleep at the end"), std::string::npos) << outcome.out;
  const Json summary = Json::parse(contents(folder_.path() / "full" / "summary.json"));
  EXPECT_EQ(summary["asleep_at_end"], 0);
  EXPECT_EQ(summary["work_skipped"], 0.0);
}

TEST_F(EventCommands, TheSummaryHasTheNumberOfBodiesAndTheClosingLinesNameAnEventThatFoundNone) {
  const std::string events =
      " --set 'event=[{time = 0, do = \"wake\"}, {time = 1, do = \"remove\", body = [0, 1]},"
      " {time = 1, do = \"kick\", velocity = [1, 0], box = [[90, 90], [91, 91]]}]'";
  const Outcome outcome =
      talus_command("run " + (folder_ / "scene.toml") + events + " --no-telemetry --out " + (folder_ / "hits"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json summary = Json::parse(contents(folder_.path() / "hits" / "summary.json"));
  std::vector<std::string> texts;
  for (const Json& event : summary["events"]) texts.push_back(event["text"]);
  EXPECT_EQ(texts, std::vector<std::string>({"wake all bodies: 3", "remove some bodies: 2", "kick some bodies: 0"}));
  const std::string line = "event[2], kick some bodies, found no body to act on";
  EXPECT_EQ(summary["scene_warnings"], Json::array({line}));
  EXPECT_NE(outcome.out.find("warning: " + line), std::string::npos) << outcome.out;
}

TEST_F(EventCommands, ARecordOfASceneWithoutEventsNamesNoSuchChannel) {
  std::ofstream(folder_.path() / "plain.toml")
      << "title = \"plain\"\ndimension = 2\nshape.disc = {kind = \"ball\", radius = 0.5}\nrun = {frames = 5}\n"
         "body = [{position = [0, 2.5]}]\n";
  const std::string plain = "run " + (folder_ / "plain.toml") + " --no-telemetry --out " + (folder_ / "plain");
  ASSERT_EQ(talus_command(plain).exit_code, 0);
  EXPECT_EQ(contents(folder_.path() / "plain" / "run.lcm").find("TALUS_EVENTS"), std::string::npos);
  EXPECT_NE(contents(folder_.path() / "run" / "run.lcm").find("TALUS_EVENTS"), std::string::npos);
}

}  // namespace
}  // namespace talus::event_commands_test

#endif

// `talus compare` on recorded runs.

#ifdef TALUS_LCM

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>

#include "lcmtypes/layout.h"
#include "lcmtypes/wire.h"
#include "tests/process/process.h"

namespace talus::record_command_test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// A pour of ten seconds in the named folder.
void record(const TemporaryFolder& folder, const std::string& name, const std::string& options) {
  const Outcome outcome = talus_command("run drop_in_a_pile_2d --no-telemetry --set run.frames=150 --out " +
                                        (folder / name) + " " + options);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
}

Json answer(const std::string& arguments) {
  const Outcome outcome = talus_command(arguments + " --json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return Json::parse(outcome.out);
}

TEST(CompareCommand, CallsARunPlayedTwiceEqualAndAllDistancesZero) {
  const TemporaryFolder folder;
  record(folder, "a", "--set policy.tau=0.3");
  record(folder, "b", "--set policy.tau=0.3");
  const Json json = answer("compare " + (folder / "a") + " " + (folder / "b"));
  EXPECT_TRUE(json["first_difference"].is_null());
  EXPECT_TRUE(json["first_other_sleep_decision"].is_null());
  EXPECT_EQ(json["frames_compared"], 150);
  EXPECT_EQ(json["motion"]["R"], 0.0);
  EXPECT_EQ(json["distance_D"]["max_at_end"], 0.0);
  EXPECT_EQ(json["profile_rms_D"], 0.0);
  EXPECT_EQ(json["z"]["ks"], 0.0);
}

TEST(CompareCommand, KnowsTheDefaultsOfASceneWithMeshesInAnyFolder) {
  const TemporaryFolder folder;
  std::ofstream(folder / "rock.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  for (const auto& [name, more] : {std::pair("a", ""), {"b", "seed = 1\n"}}) {
    std::ofstream(folder / name + ".toml")
        << "title = \"Rocks\"\ndimension = 2\n"
        << more << "shape.rock = {kind = \"mesh\", file = \"rock.obj\", longest_side = 1}\nsource = [{count = 2}]\n"
        << "run = {frames = 30}\n";
    const Outcome run = talus_command("run " + (folder / name) + ".toml --no-telemetry --out " + (folder / name));
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  std::filesystem::remove(folder / "rock.obj");
  const Json json = answer("compare " + (folder / "a") + " " + (folder / "b"));
  EXPECT_EQ(json["settings_that_differ"], Json::array());
}

TEST(CompareCommand, LeavesBodiesThatFallOutOfTheShapes) {
  const TemporaryFolder folder;
  std::ofstream(folder / "scene.toml")
      << "title = \"One lies, one falls\"\ndimension = 2\nshape.disc = {kind = \"ball\", radius = 0.5}\n"
         "body = [{position = [0, 0.5]}, {position = [3, 40]}]\nrun = {frames = 30}\npolicy.kind = \"full\"\n";
  const std::string run = folder / "run";
  ASSERT_EQ(talus_command("run " + (folder / "scene.toml") + " --no-telemetry --out " + run).exit_code, 0);
  const Json shape = answer("compare " + run + " " + run)["shape_a"];
  EXPECT_NEAR(shape["centre_height_m"].get<double>(), 0.5, 0.05);
  EXPECT_EQ(shape["centre_height_m"], Json::parse(contents(run + "/summary.json"))["shape"]["centre_height_m"]);
}

TEST(CompareCommand, SaysThatNoBodyRestsWhereAllFall) {
  const TemporaryFolder folder;
  std::ofstream(folder / "scene.toml")
      << "title = \"One falls\"\ndimension = 2\nshape.disc = {kind = \"ball\", radius = 0.5}\n"
         "body = [{position = [3, 40]}]\nrun = {frames = 30}\n";
  const std::string run = folder / "run";
  const std::string other = folder / "other";
  ASSERT_EQ(talus_command("run " + (folder / "scene.toml") + " --no-telemetry --out " + run).exit_code, 0);
  ASSERT_EQ(
      talus_command("run " + (folder / "scene.toml") + " --no-telemetry --set body[0].position=[3,30] --out " + other)
          .exit_code,
      0);
  const Json json = answer("compare " + run + " " + other + " --twins 1");
  EXPECT_TRUE(json["shape_a"].is_null());
  EXPECT_EQ(json["verdict"],
            "Piles of different scenes: no shapes to compare: no body of either rests at the last "
            "frame that both have.");
  EXPECT_EQ(talus_command("compare " + run + " " + other).exit_code, 0);
}

TEST(CompareCommand, RefusesRunsWithoutABody) {
  const TemporaryFolder folder;
  record(folder, "a", "--set source[0].start=1000");
  const Outcome outcome = talus_command("compare " + (folder / "a") + " " + (folder / "a"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("there is nothing to compare"), std::string::npos) << outcome.err;
}

TEST(CompareCommand, CallsADamagedRecordNoDifferentFromItself) {
  const TemporaryFolder folder;
  record(folder, "a", "");
  std::string log = contents(folder / "a/run.lcm");
  const std::size_t at = log.find("TALUS_BODIES", log.size() / 2) + 60;
  log[at] = static_cast<char>(log[at] ^ 1);
  std::ofstream(folder / "a/run.lcm", std::ios::binary) << log;
  const Json json = answer("compare " + (folder / "a") + " " + (folder / "a"));
  EXPECT_EQ(json["verdict"], "No difference in what both records have; damage has taken the rest.");
}

TEST(CompareCommand, NamesTheStepOfTheFirstSleepDecisionAndTheDifferenceSoonAfterIt) {
  const TemporaryFolder folder;
  record(folder, "full", "--policy full");
  record(folder, "piled", "--set policy.tau=0.3");
  const Json json = answer("compare " + (folder / "full") + " " + (folder / "piled"));
  const int decision = json["first_other_sleep_decision"]["step"];
  EXPECT_FALSE(json["first_other_sleep_decision"]["woke"].get<bool>());
  EXPECT_LE(json["first_difference"]["after_step"], decision) << "nothing differs before a body is put to sleep";
  EXPECT_LE(decision, json["first_difference"]["by_step"].get<int>());
  EXPECT_GT(json["motion"]["R"], 0.0);
  EXPECT_LT(json["motion"]["S"], 1.0);
}

TEST(Options, AreRefusedWhereTheyAreNoSensibleNumber) {
  for (const char* value : {"inf", "nan", "-1", "1e300", "1e99999"})
    for (const char* option :
         {"run drop_in_a_pile_2d --hash --telemetry-hz=", "monitor --seconds=", "monitor --interval="})
      EXPECT_EQ(talus_command(std::string(option) + value).exit_code, 2) << option << value;
}

TEST(CompareCommand, NamesTheSettingsInWhichTwoScenesDiffer) {
  const TemporaryFolder folder;
  record(folder, "a", "");
  record(folder, "b", "--set source[0].rate=5");
  const std::string both = (folder / "a") + " " + (folder / "b");
  const Json settings = answer("compare " + both)["settings_that_differ"];
  ASSERT_EQ(settings.size(), 1U);
  EXPECT_EQ(settings[0]["path"], "source[0].rate");
  EXPECT_EQ(settings[0]["b"], "5");
  EXPECT_NE(talus_command("compare " + both).out.find("runs of different scenes"), std::string::npos);
}

TEST(CompareCommand, RefusesARecordWithoutAFrame) {
  const TemporaryFolder folder;
  record(folder, "a", "");
  fs::copy(folder.path() / "a", folder.path() / "b");
  std::ofstream(folder.path() / "b" / "run.lcm", std::ios::trunc);
  const Outcome outcome = talus_command("compare " + (folder / "a") + " " + (folder / "b"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("run.lcm holds no frame"), std::string::npos) << outcome.err;
}

/// Where the data of an event lies in a log.
struct Place {
  std::size_t at = 0;
  std::size_t size = 0;
};

/// The data of each event on a channel of a sound log (for its format see lcmtypes/log_reader.cc).
std::vector<Place> events(const std::string& log, const std::string& channel) {
  const auto number = [&](std::size_t at) {
    return big_endian(std::span(reinterpret_cast<const std::uint8_t*>(log.data()) + at, 4));
  };
  std::vector<Place> places;
  for (std::size_t at = 0; at < log.size();) {
    const std::size_t data = at + 28 + number(at + 20);
    const std::size_t size = number(at + 24);
    if (log.substr(at + 28, number(at + 20)) == channel) places.push_back({data, size});
    at = data + size;
  }
  return places;
}

TEST(CompareCommand, RefusesARecordOfAnotherFormatByItsNumberAndVersion) {
  const TemporaryFolder folder;
  record(folder, "a", "");
  const fs::path file = folder.path() / "a" / "run.lcm";
  std::string log = contents(file);
  for (const Place& place : events(log, "TALUS_RUN")) {
    const std::span bytes(reinterpret_cast<std::uint8_t*>(log.data()) + place.at, place.size);
    bytes[header_bytes + 3] = 9;
    renumber(bytes, 0);  // with the checksum that follows
  }
  std::ofstream(file, std::ios::binary) << log;
  const std::string run = folder / "a";
  for (const std::string& command : {"compare " + run + " " + run, "export " + run + " --out " + (folder / "x.csv"),
                                     "replay " + run + " --out " + (folder / "x.html")}) {
    const Outcome outcome = talus_command(command);
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_NE(outcome.err.find("run.lcm: format 9 of talus "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("must be format "), std::string::npos) << outcome.err;
  }
}

/// Copies run `from` to `to` with its record as `change` leaves it.
void copy_run(const TemporaryFolder& folder, const char* from, const char* to,
              const std::function<void(std::string&)>& change) {
  fs::remove_all(folder.path() / to);
  fs::copy(folder.path() / from, folder.path() / to);
  std::string log = contents(folder.path() / to / "run.lcm");
  change(log);
  std::ofstream(folder.path() / to / "run.lcm", std::ios::binary | std::ios::trunc) << log;
}

TEST(CompareCommand, StopsAtARecordThatIsNotOfItsScene) {
  const TemporaryFolder folder;
  record(folder, "whole", "");
  copy_run(folder, "whole", "harmed", [&](std::string& log) { log[events(log, "TALUS_SCENE").at(0).at + 100] ^= 4; });
  std::string scene = contents(folder.path() / "whole" / "scene.toml");
  scene.replace(scene.find("count = 400"), 11, "count = 2");
  std::ofstream(folder.path() / "harmed" / "scene.toml") << scene;
  const Outcome outcome = talus_command("compare " + (folder / "harmed") + " " + (folder / "whole"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("the scene has 2 bodies"), std::string::npos) << outcome.err;
}

TEST(CompareCommand, LeavesOutADamagedFrameAndNothingElse) {
  const TemporaryFolder folder;
  record(folder, "whole", "--set policy.tau=0.2");
  const std::string both = "compare " + (folder / "whole") + " " + (folder / "harmed");
  for (const std::size_t frame : {0U, 1U, 39U, 75U, 76U, 148U}) {
    copy_run(folder, "whole", "harmed",
             [&](std::string& log) { log[events(log, "TALUS_BODIES").at(frame).at + 60] ^= 4; });
    const Json json = answer(both);
    EXPECT_EQ(json["b"]["lost_steps"], Json({2 * frame + 2}));
    EXPECT_EQ(json["frames_compared"], 149);
    EXPECT_TRUE(json["first_difference"].is_null()) << "all that is known is equal: " << json["first_difference"];
    EXPECT_EQ(json["motion"]["R"], 0.0);
    EXPECT_EQ(json["distance_D"]["max_at_end"], 0.0);
    EXPECT_NE(talus_command(both).out.find(fmt::format("1 frame left out (step {})", 2 * frame + 2)),
              std::string::npos);
  }
}

TEST(CompareCommand, PrintsForgedTextsWithoutHarm) {
  const TemporaryFolder folder;
  record(folder, "a", "");
  copy_run(folder, "a", "b", [](std::string& log) {
    for (const Place& place : events(log, "TALUS_RUN")) {
      std::string data = log.substr(place.at, place.size);
      data.replace(data.find("adaptive"), 8, "\xff\x1b[2J\xc3(\x9b");
      const auto bytes = std::span(reinterpret_cast<const std::uint8_t*>(data.data()), data.size() - 4);
      const std::uint32_t sum = checksum(bytes);
      for (std::size_t i = 0; i < 4; ++i) data[data.size() - 4 + i] = static_cast<char>(sum >> (24 - 8 * i));
      log.replace(place.at, place.size, data);
    }
  });
  const std::string both = "compare " + (folder / "b") + " " + (folder / "a");
  EXPECT_EQ(answer(both)["a"]["policy"], "\ufffd\x1b[2J\ufffd(\ufffd");
  for (const std::string& arguments : {both, both + " --json"}) {
    const Outcome outcome = talus_command(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find_first_of("\x1b\xff\x9b"), std::string::npos) << outcome.out;
  }
}

TEST(Titles, ArePrintedWithoutTerminalCommands) {
  const TemporaryFolder folder;
  const std::string title = R"(--set 'title="a\u001b[2Jb\u009b3Jc"')";
  const std::string run = folder / "run";
  for (const std::string& arguments :
       {"check drop_in_a_pile_2d " + title,
        "run drop_in_a_pile_2d --no-telemetry --set run.frames=2 " + title + " --out " + run}) {
    const Outcome outcome = talus_command(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ((outcome.out + outcome.err).find_first_of("\x1b\x9b"), std::string::npos) << outcome.out;
  }
}

}  // namespace
}  // namespace talus::record_command_test

#endif

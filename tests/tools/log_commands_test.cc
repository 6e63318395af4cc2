// `talus info` on records: numbers, messages, repair.

#ifdef TALUS_LCM

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "lcmtypes/channels.h"
#include "lcmtypes/log_reader.h"
#include "lcmtypes/wire.h"
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
  ASSERT_EQ(json["runs"].size(), 1U);
  EXPECT_EQ(json["runs"][0]["frames"], 300);
  EXPECT_EQ(json["runs"][0]["reason"], "finished");
  EXPECT_EQ(json["runs"][0]["end_s"], 10.0);
  EXPECT_LT(json["runs"][0]["stamps_apart_s"], 1e-3);
  EXPECT_NEAR(json["stamps"]["end_s"], 10.0, 0.01);
  EXPECT_EQ(json["stamps"]["backward"], 0);
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
  EXPECT_EQ(json["runs"][0]["frames"], 299);
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

TEST_F(LogCommand, InfoPrintsEachMessageWhateverTheStampOfTheFirst) {
  std::string log = contents(folder_.path() / "run" / "run.lcm");
  for (std::size_t i = 0; i < 8; ++i) log[12 + i] = static_cast<char>(i < 5 ? 0 : 100);  // 6.6 s
  std::filesystem::create_directory(folder_.path() / "first");
  std::ofstream(folder_.path() / "first" / "run.lcm", std::ios::binary) << log;
  const std::string all = talus_command("info --messages " + (folder_ / "run")).out;
  const std::string same = talus_command("info --messages " + (folder_ / "first")).out;
  EXPECT_EQ(std::ranges::count(same, '\n'), std::ranges::count(all, '\n'));
}

TEST_F(LogCommand, InfoNamesTheChannelsWhereAChosenOneHasNoMessage) {
  const Outcome outcome = talus_command("info --messages --channel TALUS_CONTACTS " + (folder_ / "run"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("--channel TALUS_CONTACTS: no message in the log; its channels are"), std::string::npos);
  EXPECT_NE(outcome.err.find("TALUS_SLEEP,"), std::string::npos) << outcome.err;
}

TEST_F(LogCommand, InfoRefusesAChannelThatIsNone) {
  const Outcome outcome = talus_command("info --messages --channel TALUS_SLEEPS " + (folder_ / "run"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("--channel = TALUS_SLEEPS: must be a channel of the log"), std::string::npos)
      << outcome.err;
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

TEST_F(LogCommand, RepairWritesAllFilesOfTheSceneThatTheRecordHolds) {
  const fs::path folder = folder_.path();
  std::ofstream(folder / "rock.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  std::ofstream(folder / "scene.toml") << "title = \"Rocks\"\ndimension = 2\nrun.frames = 5\nsource = [{count = 2}]\n"
                                          "shape.rock = {kind = \"mesh\", file = \"rock.obj\", longest_side = 1}\n";
  ASSERT_EQ(talus_command("run " + (folder_ / "scene.toml") + " --no-telemetry --out " + (folder_ / "rocks")).exit_code,
            0);
  std::string log = contents(folder / "rocks" / "run.lcm");
  const auto repair = [&](const std::string& copy) {
    fs::create_directory(folder / "hurt");
    std::ofstream(folder / "hurt" / "run.lcm", std::ios::binary) << log;
    return talus_command("info --repair " + (folder_ / "hurt") + " --out " + (folder_ / copy));
  };
  const Outcome whole = repair("whole");
  EXPECT_EQ(whole.err, "");
  for (const char* name : {"rock.obj", "scene.toml"})
    EXPECT_EQ(contents(folder / "whole" / name), contents(folder / "rocks" / name)) << name;
  EXPECT_EQ(
      talus_command("run " + (folder_ / "whole/scene.toml") + " --no-telemetry --out " + (folder_ / "again")).exit_code,
      0);
  log[log.find("v 0 1 0")] = 'w';
  const Outcome hurt = repair("part");
  EXPECT_EQ(hurt.exit_code, 0);
  EXPECT_NE(hurt.err.find("the record does not hold all files of its scene"), std::string::npos) << hurt.err;
  EXPECT_NE(hurt.err.find("rock.obj"), std::string::npos) << hurt.err;
}

TEST_F(LogCommand, RepairCountsWhatIsDamagedAtTheEnd) {
  const std::string whole = contents(folder_.path() / "run" / "run.lcm");
  std::filesystem::create_directory(folder_.path() / "hurt");
  std::ofstream(folder_.path() / "hurt" / "run.lcm", std::ios::binary) << whole.substr(0, whole.size() - 10);
  const Outcome outcome = talus_command("info --repair " + (folder_ / "hurt") + " --out " + (folder_ / "whole"));
  EXPECT_EQ(outcome.out.find(" 0 damaged bytes"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(" in 1 places left out"), std::string::npos) << outcome.out;
}

/// An event as it stands in a log.
std::string event(std::int64_t stamp, const std::string& channel, const std::string& data) {
  const auto bytes = [](std::uint64_t value, int size) {
    std::string text;
    for (int i = size - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 255U);
    return text;
  };
  return "\xED\xA1\xDA\x01" + bytes(0, 8) + bytes(static_cast<std::uint64_t>(stamp), 8) + bytes(channel.size(), 4) +
         bytes(data.size(), 4) + channel + data;
}

/// A log without talus: an event each half second from two seconds on, with these stamps in its middle [s].
std::string foreign_log(const std::vector<double>& middle = {}) {
  std::vector<double> stamps = {2.0, 2.5, 3.0};
  stamps.insert(stamps.end(), middle.begin(), middle.end());
  for (const double stamp : {6.0, 6.5, 7.0}) stamps.push_back(stamp);
  std::string log;
  for (const double stamp : stamps) log += event(std::llround(1e6 * stamp), "HELLO", "abc");
  return log;
}

class ForeignLog : public testing::Test {
 protected:
  void write(const std::string& log) { std::ofstream(folder_.path() / "a.lcm", std::ios::binary) << log; }
  Outcome info(const std::string& options) { return talus_command("info " + (folder_ / "a.lcm") + " " + options); }
  Json stamps(const std::string& log) {
    write(log);
    return Json::parse(info("--json").out)["stamps"];
  }
  /// The stamps of the log after repair [s].
  std::vector<double> repaired(const std::string& log) {
    write(log);
    std::filesystem::remove_all(folder_.path() / "copy");
    EXPECT_EQ(info("--repair --out " + (folder_ / "copy")).exit_code, 0);
    std::istringstream lines(talus_command("info --messages " + (folder_ / "copy")).out);
    std::vector<double> all;
    for (std::string line; std::getline(lines, line);)
      all.push_back(1e-6 * Json::parse(line)["stamp_us"].get<double>());
    return all;
  }

  TemporaryFolder folder_;
};

TEST_F(ForeignLog, HasTheTimeOfItsStamps) {
  const Json json = stamps(foreign_log());
  EXPECT_EQ(json["begin_s"], 2.0);
  EXPECT_EQ(json["end_s"], 7.0);
  EXPECT_EQ(json["longest_gap_s"], 3.0);
  EXPECT_EQ(json["longest_gap_at_s"], 1.0);
  EXPECT_NE(info("").out.find("stamps 2.00 to 7.00 s"), std::string::npos);
  EXPECT_NE(info("").out.find("no run of talus"), std::string::npos);
  const std::string some = info("--messages --from 0.5 --to 4.2").out;
  EXPECT_EQ(std::ranges::count(some, '\n'), 3) << some;
  write(event(1'766'000'000'250'000, "HELLO", "abc"));
  EXPECT_NE(info("").out.find("stamps 2025-12-17 19:33:20 UTC"), std::string::npos) << info("").out;
}

TEST_F(ForeignLog, TellsOfGapsAndOfStampsThatGoBack) {
  write(foreign_log({3.5, 603.0, 603.5}));
  EXPECT_NE(info("").out.find("3 stamps are earlier than one before them"), std::string::npos) << info("").out;
  std::string log;
  for (int i = 0; i < 100; ++i) log += event(1000 * i + (i < 50 ? 0 : 600'000'000), "HELLO", "abc");
  write(log);
  EXPECT_NE(info("").out.find("no message for 600.00 s, from 0.05 s after"), std::string::npos) << info("").out;
}

TEST_F(ForeignLog, IsRepairedToStampsThatAPlayerCanGoBy) {
  const std::vector<double> whole = repaired(foreign_log({3.5, 4.0}));
  EXPECT_EQ(whole, std::vector<double>({2.0, 2.5, 3.0, 3.5, 4.0, 6.0, 6.5, 7.0}));
  EXPECT_EQ(repaired(foreign_log({3.5, 4000.0, 4.0}))[4], 3.5) << "a bit of a stamp was flipped upwards";
  EXPECT_EQ(repaired(foreign_log({3.5, -9e9, 4.0}))[4], 3.5) << "its sign";
  EXPECT_EQ(repaired(foreign_log({3.5, 0.1, 4.0}))[4], 3.5) << "downwards";
  EXPECT_EQ(repaired(foreign_log() + event(4'000'000'000, "HELLO", "abc")).back(), 7.0) << "that of the last event";
  EXPECT_EQ(repaired(event(-4'000'000'000, "HELLO", "abc") + foreign_log()).front(), 2.0) << "that of the first";
  EXPECT_EQ(repaired(event(4'000'000'000, "HELLO", "abc") + foreign_log()).front(), 2.0) << "upwards";
}

TEST_F(LogCommand, RepairMendsAFlippedBitInAStampWhereverItIs) {
  const std::string whole = contents(folder_.path() / "run" / "run.lcm");
  for (const std::size_t near : {std::size_t{1}, whole.size() / 2, whole.size() - 900}) {
    const std::size_t at = whole.find("\xED\xA1\xDA\x01", near);
    ASSERT_NE(at, std::string::npos);
    std::string log = whole;
    log[at + 12 + 3] = static_cast<char>(log[at + 12 + 3] ^ 1);  // 2^32 us, an hour and more
    std::filesystem::create_directory(folder_.path() / "hurt");
    std::ofstream(folder_.path() / "hurt" / "run.lcm", std::ios::binary) << log;
    std::filesystem::remove_all(folder_.path() / "whole");
    const Outcome outcome = talus_command("info --repair " + (folder_ / "hurt") + " --out " + (folder_ / "whole"));
    EXPECT_NE(outcome.out.find(" 1 stamps mended"), std::string::npos) << outcome.out;
    const Json stamps = info("whole")["stamps"];
    EXPECT_LT(stamps["longest_gap_s"], 0.1);
    EXPECT_EQ(stamps["backward"], 0);
  }
}

/// The record with its messages about the run in a format of a later version, all else as it was.
std::string in_format_7(const fs::path& record) {
  std::string log;
  LogReader reader(record.string());
  std::int64_t seq = 0;
  for (LogEvent each; reader.next(each);) {
    if (each.channel == name_of(Channel::run)) {
      each.data[header_bytes + 3] = 7;
      renumber(each.data, seq++);
    }
    log += event(each.timestamp, each.channel, std::string(each.data.begin(), each.data.end()));
  }
  return log;
}

TEST_F(LogCommand, InfoNamesTheFormatOfARunThatItCannotRead) {
  std::ofstream(folder_.path() / "later.lcm", std::ios::binary) << in_format_7(folder_.path() / "run" / "run.lcm");
  const Outcome outcome = talus_command("info " + (folder_ / "later.lcm"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("messages of format 7 of talus "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(": no message that describes it can be read"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("policy"), std::string::npos) << outcome.out;
  EXPECT_TRUE(info("run")["other_format"].is_null());
}

TEST_F(LogCommand, TellsOfStampsThatLeaveTheTimesOfTheirMessages) {
  std::string log = contents(folder_.path() / "run" / "run.lcm");
  const std::size_t half = log.size() / 2;
  for (std::size_t at = log.find("\xED\xA1\xDA\x01", half); at != std::string::npos;
       at = log.find("\xED\xA1\xDA\x01", at + 4)) {
    std::uint64_t stamp = 0;
    for (std::size_t i = 0; i < 8; ++i) stamp = stamp << 8U | static_cast<std::uint8_t>(log[at + 12 + i]);
    stamp += 600'000'000;
    for (std::size_t i = 0; i < 8; ++i) log[at + 12 + i] = static_cast<char>(stamp >> (56 - 8 * i) & 255U);
  }
  std::filesystem::create_directory(folder_.path() / "late");
  std::ofstream(folder_.path() / "late" / "run.lcm", std::ios::binary) << log;
  EXPECT_NEAR(info("late")["runs"][0]["stamps_apart_s"], 600.0, 0.01);
  EXPECT_NE(talus_command("info " + (folder_ / "late")).out.find("run apart by 600.00 s"), std::string::npos);
}

TEST_F(LogCommand, NamesBothRunsOfAJoinedLogAndTakesOneOut) {
  const Outcome other =
      talus_command("run drop_in_a_pile_2d --no-telemetry --seed 2 --set run.frames=10 --out " + (folder_ / "other"));
  ASSERT_EQ(other.exit_code, 0) << other.err;
  std::ofstream(folder_.path() / "both.lcm", std::ios::binary)
      << contents(folder_.path() / "run" / "run.lcm") << contents(folder_.path() / "other" / "run.lcm");
  const Json runs = info("both.lcm")["runs"];
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0]["frames"], 300);
  EXPECT_EQ(runs[1]["frames"], 10);
  EXPECT_EQ(runs[1]["seed"], 2);
  const std::string both = folder_ / "both.lcm";
  for (const std::string& command : {"replay --out " + (folder_ / "a.html"), "film --out " + (folder_ / "a.gif"),
                                     "export --out " + (folder_ / "a.csv"), "compare " + (folder_ / "run")}) {
    const Outcome outcome = talus_command(command + " " + both);
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_NE(outcome.err.find("must be of one run; `talus info --repair --run"), std::string::npos) << outcome.err;
  }
  const std::string second = runs[1]["run"];
  ASSERT_EQ(talus_command("info --repair --run " + second + " " + both + " --out " + (folder_ / "second")).exit_code,
            0);
  EXPECT_TRUE(contents(folder_.path() / "second" / "run.lcm").size() ==
              contents(folder_.path() / "other" / "run.lcm").size());
  EXPECT_EQ(talus_command("compare " + (folder_ / "second") + " " + (folder_ / "other")).exit_code, 0);
  const Outcome none = talus_command("info --repair --run 12345678 " + both + " --out " + (folder_ / "none"));
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("must be a run that is in"), std::string::npos) << none.err;
}

TEST_F(LogCommand, RefusesAFileWithoutAnEvent) {
  std::ofstream(folder_.path() / "notes.txt") << "These are notes on a pile.\n";
  for (const std::string& command :
       {std::string("info"), std::string("info --messages"), "info --repair --out " + (folder_ / "new"),
        "replay --out " + (folder_ / "a.html"), "film --out " + (folder_ / "a.gif"),
        "export --out " + (folder_ / "a.csv"), "compare " + (folder_ / "run")}) {
    const Outcome outcome = talus_command(command + " " + (folder_ / "notes.txt"));
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_NE(outcome.err.find("or an LCM event log, but no event is in its 27 bytes"), std::string::npos)
        << outcome.err;
  }
  EXPECT_FALSE(fs::exists(folder_.path() / "new"));
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

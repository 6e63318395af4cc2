// `talus compare` and `talus wake` on recorded runs.

#ifdef TALUS_LCM

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/process.h"

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
  EXPECT_EQ(json["motion"]["ratio_R"], 0.0);
  EXPECT_EQ(json["distance_D"]["max_at_end"], 0.0);
  EXPECT_EQ(json["profile_rms_D"], 0.0);
  EXPECT_EQ(json["z"]["ks"], 0.0);
}

TEST(CompareCommand, NamesTheStepOfTheFirstSleepDecisionAndTheDifferenceSoonAfterIt) {
  const TemporaryFolder folder;
  record(folder, "full", "--policy full");
  record(folder, "piled", "--set policy.tau=0.3");
  const Json json = answer("compare " + (folder / "full") + " " + (folder / "piled"));
  const int decision = json["first_other_sleep_decision"]["step"];
  EXPECT_FALSE(json["first_other_sleep_decision"]["woke"].get<bool>());
  EXPECT_LE(json["first_difference"]["after_step"], decision) << "nothing differs before somebody is put to sleep";
  EXPECT_LE(decision, json["first_difference"]["by_step"].get<int>());
  EXPECT_GT(json["motion"]["ratio_R"], 0.0);
  EXPECT_LT(json["motion"]["symmetric_S"], 1.0);
}

TEST(CompareCommand, RefusesAFolderThatIsNoRun) {
  const TemporaryFolder folder;
  record(folder, "a", "");
  const Outcome none = talus_command("compare " + (folder / "a") + " " + (folder / "b"));
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("scene.toml"), std::string::npos) << none.err;
}

TEST(CompareCommand, StopsAtARecordThatIsNotOfItsScene) {
  const TemporaryFolder folder;
  record(folder, "a", "");
  std::string scene = contents(folder.path() / "a" / "scene.toml");
  scene.replace(scene.find("count = 400"), 11, "count = 2");
  std::ofstream(folder.path() / "a" / "scene.toml") << scene;
  const Outcome outcome = talus_command("compare " + (folder / "a") + " " + (folder / "a"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("the scene has 2 bodies"), std::string::npos) << outcome.err;
}

TEST(WakeCommand, TellsHowFarTheSleepersDriftAndTakesTheFullRunsDriftOff) {
  const TemporaryFolder folder;
  record(folder, "full", "--policy full --set source[0].count=15");
  record(folder, "piled", "--set policy.tau=0.2 --set source[0].count=15");
  const Json json = answer("wake " + (folder / "piled") + " --full " + (folder / "full") + " --seconds 1");
  EXPECT_EQ(json["bodies"], 15);
  EXPECT_GT(json["asleep"], 0);
  EXPECT_EQ(json["floating_sleepers"], 0);
  EXPECT_EQ(json["sunken_sleepers"], 0);
  EXPECT_LT(json["penetration_D"]["max"], 0.2);
  const double drift = json["after_waking"]["drift_mean_D"];
  EXPECT_GT(drift, 0.0);
  EXPECT_DOUBLE_EQ(json["beyond_full_run"]["drift_mean_D"], drift - json["full_run"]["drift_mean_D"].get<double>());
}

TEST(WakeCommand, FindsASceneInTheAirUpset) {
  const TemporaryFolder folder;
  record(folder, "falling", "--policy full --set run.frames=15");
  const Json json = answer("wake " + (folder / "falling") + " --seconds 1");
  EXPECT_GT(json["after_waking"]["drift_max_D"], 1.0) << "what falls at 10 m/s goes on falling: velocities come along";
}

}  // namespace
}  // namespace talus::record_command_test

#endif

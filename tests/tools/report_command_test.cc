// `talus report` on recorded runs. What a browser shows of it is tested in tests/browser.

#ifdef TALUS_LCM

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/process/process.h"

namespace talus::report_command_test {
namespace {

void record(const std::string& folder, const std::string& arguments) {
  const Outcome run = talus_command("run " + arguments + " --no-telemetry --out " + folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
}

std::string report(const std::string& arguments, const std::string& file) {
  const Outcome outcome = talus_command("report " + arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return contents(file);
}

int count(const std::string& text, const std::string& part) {
  int number = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++number;
  return number;
}

TEST(ReportCommand, HasPlayerPlotsResultSettingsAndHashInOneFile) {
  const TemporaryFolder folder;
  record(folder / "run", "drop_in_a_pile_2d --set run.frames=450");
  const std::string page = report(folder / "run", folder / "run/report.html");
  EXPECT_EQ(count(page, "<iframe"), 1) << "the player";
  EXPECT_GE(count(page, "<figure><svg"), 5) << "bodies, densities, time per step, events, slope";
  for (const char* heading : {"Result", "Warnings", "Error", "Over time", "Settings"})
    EXPECT_NE(page.find(std::string("<h2>") + heading + "</h2>"), std::string::npos) << heading;
  const auto summary = nlohmann::json::parse(contents(folder / "run/summary.json"));
  EXPECT_NE(page.find(summary["end_hash"].get<std::string>()), std::string::npos);
  for (const char* reference : {" src=\"", " href=\"", "@import", "url(http"})
    EXPECT_EQ(page.find(reference), std::string::npos) << reference;
}

TEST(ReportCommand, AMinuteOf400BodiesTakesLessThanFiveMegabytes) {
  const TemporaryFolder folder;
  record(folder / "run", "drop_in_a_pile_2d --policy full");
  report((folder / "run") + " --html " + (folder / "a.html"), folder / "a.html");
  EXPECT_LT(std::filesystem::file_size(folder / "a.html"), 5'000'000U) << "with every body awake";
}

TEST(ReportCommand, ListsTheWarningsOfTheRun) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "lost.toml")
      << "title = \"one is lost\"\ndimension = 2\nshape.disc = {kind = \"ball\", radius = 0.5}\n"
         "source = [{count = 1, rate = 10, position = [9990, 5], velocity = [90, 0]}]\n"
         "pile = [{alpha_deg = 30, at = [0, 0]}]\nrun = {frames = 60, frame_rate = 30}\n";
  record(folder / "run", (folder / "lost.toml"));
  const std::string page = report(folder / "run", folder / "run/report.html");
  EXPECT_NE(page.find("<td>outside_world</td>"), std::string::npos);
}

TEST(ReportCommand, MeasuresTheErrorOnDemand) {
  const TemporaryFolder folder;
  record(folder / "run", "drop_in_a_pile_2d --set run.frames=60");
  const std::string page = report((folder / "run") + " --wake", folder / "run/report.html");
  EXPECT_NE(page.find("<td>drift_mean_D</td>"), std::string::npos);
}

TEST(ReportCommand, SaysWhatARunFolderLacks) {
  const TemporaryFolder folder;
  record(folder / "run", "drop_in_a_pile_2d --set run.frames=60");
  std::filesystem::remove(folder.path() / "run/frames.csv");
  std::ofstream(folder / "run/summary.json") << "{";
  std::string log = contents(folder / "run/run.lcm");
  log.resize(log.size() / 2);
  std::ofstream(folder / "run/run.lcm", std::ios::binary) << log;
  const std::string page = report(folder / "run", folder / "run/report.html");
  EXPECT_NE(page.find("has no readable frames.csv"), std::string::npos);
  EXPECT_NE(page.find("has no readable summary.json"), std::string::npos);
  EXPECT_NE(page.find("The record is damaged"), std::string::npos);
}

TEST(ReportCommand, RefusesBadOptions) {
  const TemporaryFolder folder;
  const Outcome no_run = talus_command("report " + (folder / "run"));
  EXPECT_EQ(no_run.exit_code, 2);
  EXPECT_NE(no_run.err.find("must be a folder that `talus run` left"), std::string::npos) << no_run.err;
  record(folder / "run", "drop_in_a_pile_2d --set run.frames=2");
  const Outcome ending = talus_command("report " + (folder / "run") + " --html " + (folder / "a.txt"));
  EXPECT_EQ(ending.exit_code, 2);
  EXPECT_NE(ending.err.find("must end in .html"), std::string::npos) << ending.err;
}

}  // namespace
}  // namespace talus::report_command_test

#endif

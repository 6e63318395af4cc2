// `talus replay` on recorded runs. What a browser shows of it is tested in tests/browser.

#ifdef TALUS_LCM

#include <gtest/gtest.h>

#include <fstream>

#include "tests/process/process.h"

namespace talus::replay_command_test {
namespace {

void record(const std::string& folder, const std::string& scene) {
  const Outcome run = talus_command("run " + scene + " --no-telemetry --out " + folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
}

TEST(ReplayCommand, WritesOneFileThatNamesNoOther) {
  const TemporaryFolder folder;
  record(folder / "run", "drop_in_a_pile_2d --set run.frames=60");
  ASSERT_EQ(talus_command("replay " + (folder / "run") + " --out " + (folder / "a.html")).exit_code, 0);
  const std::string page = contents(folder / "a.html");
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  for (const char* reference : {"src=\"", "href=\"h", "href=\"/", "@import", "url(http"})
    EXPECT_EQ(page.find(reference), std::string::npos) << reference;
  EXPECT_EQ(page.find("<!-- "), std::string::npos) << "every mark of the page is replaced";
  ASSERT_EQ(talus_command("replay " + (folder / "run") + " --out " + (folder / "b.html")).exit_code, 0);
  EXPECT_TRUE(contents(folder / "b.html") == page) << "the same run gives the same page";
}

TEST(ReplayCommand, AMinuteOf400BodiesTakesLessThanEightMegabytes) {
  const TemporaryFolder folder;
  record(folder / "run", "drop_in_a_pile_2d --policy full");
  ASSERT_EQ(talus_command("replay " + (folder / "run") + " --out " + (folder / "a.html")).exit_code, 0);
  EXPECT_LT(std::filesystem::file_size(folder / "a.html"), 8'000'000U) << "with every body awake";
}

TEST(ReplayCommand, PlaysWhatADamagedRecordStillHas) {
  const TemporaryFolder folder;
  record(folder / "run", "drop_in_a_pile_2d --set run.frames=60");
  std::string log = contents(folder / "run/run.lcm");
  log.resize(log.size() / 2);
  std::ofstream(folder / "run/run.lcm", std::ios::binary) << log;
  EXPECT_EQ(talus_command("replay " + (folder / "run") + " --out " + (folder / "a.html")).exit_code, 0);
}

TEST(ReplayCommand, RefusesBadOptions) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& arguments, const std::string& said) {
    const Outcome outcome = talus_command("replay " + (folder / "run") + " " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  };
  refused("--out " + (folder / "a.html"), "must be a folder that `talus run` left");
  refused("--out " + (folder / "a.txt"), "must end in .html");
  refused("--out " + (folder / "none/a.html"), "must be a file in a folder that exists");
  refused("", "--out");
}

}  // namespace
}  // namespace talus::replay_command_test

#endif

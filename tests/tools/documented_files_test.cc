// docs/files.md against the files that a run writes.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "common/policy/phase_times.h"
#include "tests/process/process.h"

namespace talus::documented_files_test {
namespace {

using Json = nlohmann::json;
using Names = std::set<std::string>;

/// The first cells of the table under a heading of docs/files.md.
Names documented(const std::string& heading) {
  std::istringstream lines(contents(std::string(TALUS_SOURCE_DIR) + "/docs/files.md"));
  Names names;
  bool within = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) within = line == "## " + heading;
    if (within && line.starts_with("| `")) names.insert(line.substr(3, line.find('`', 3) - 3));
  }
  return names;
}

/// The paths of all plain values: "shape.r50_m", "piles[].layers".
void collect(const Json& value, const std::string& path, Names& names) {
  if (value.is_object()) {
    for (const auto& [key, child] : value.items()) collect(child, path.empty() ? key : path + "." + key, names);
  } else if (value.is_array()) {
    for (const Json& child : value) collect(child, path + "[]", names);
  } else {
    names.insert(path);
  }
}

/// Three discs fall, one is thrown beyond the world's edge, which gives a warning. The folder that the run leaves.
std::filesystem::path run_in(const TemporaryFolder& folder) {
  std::ofstream(folder.path() / "scene.toml")
      << "title = \"three discs and one that is lost\"\n"
         "dimension = 2\n"
         "shape.disc = {kind = \"ball\", radius = 0.5}\n"
         "source = [{shape = \"disc\", count = 3, rate = 10, position = [0, 3]},\n"
         "          {shape = \"disc\", count = 1, rate = 10, position = [9990, 5], velocity = [90, 0]}]\n"
         "pile = [{alpha_deg = 30, at = [0, 0]}]\n"
         "run = {frames = 60, frame_rate = 30}\n";
  const Outcome outcome = talus_command("run " + (folder / "scene.toml") + " --no-telemetry --out " + (folder / "run"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return folder.path() / "run";
}

/// Those of `names` that `others` lacks.
std::string missing(const Names& names, const Names& others) {
  std::string list;
  for (const std::string& name : names) {
    if (!others.contains(name)) list += name + " ";
  }
  return list;
}

void expect_documented(const Names& written, const std::string& heading) {
  EXPECT_EQ(missing(written, documented(heading)), "") << "written, but not in docs/files.md under " << heading;
  EXPECT_EQ(missing(documented(heading), written), "") << "in docs/files.md under " << heading << ", but not written";
}

TEST(DocumentedFiles, HaveAllColumnsOfFramesCsv) {
  const TemporaryFolder folder;
  std::istringstream csv(contents(run_in(folder) / "frames.csv"));
  std::string header;
  std::getline(csv, header);
  std::istringstream cells(header);
  Names columns;
  for (std::string cell; std::getline(cells, cell, ',');) columns.insert(cell);
  expect_documented(columns, "frames.csv");
}

TEST(DocumentedFiles, GiveEachPhaseOfAStepTheMeaningOfItsDeclaration) {
  const std::string page = contents(std::string(TALUS_SOURCE_DIR) + "/docs/files.md");
  for (const Phase& phase : all_phases) {
    const std::string row = "| `" + std::string(phase.name) + "_ms` | " + std::string(phase.meaning) + " |\n";
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

TEST(DocumentedFiles, HaveAllKeysOfSummaryJson) {
  const TemporaryFolder folder;
  Names keys;
  collect(Json::parse(contents(run_in(folder) / "summary.json")), "", keys);
  expect_documented(keys, "summary.json");
}

}  // namespace
}  // namespace talus::documented_files_test

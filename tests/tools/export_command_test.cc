// `talus export` on recorded runs, read back: in C++, and by NumPy and VTK where Debian's Python has them.

#ifdef TALUS_LCM

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/common/documented_names.h"
#include "tests/process/process.h"

namespace talus::export_command_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A pour of ten seconds in the folder run.
void record(const TemporaryFolder& folder, const std::string& options = "") {
  const Outcome outcome = talus_command(
      fmt::format("run drop_in_a_pile_2d --no-telemetry --set run.frames=150 --out {} {}", folder / "run", options));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
}

Outcome export_run(const TemporaryFolder& folder, const std::string& options) {
  return talus_command("export " + (folder / "run") + " " + options);
}

/// The rows of a CSV file as cells, the head first.
std::vector<std::vector<std::string>> rows_of(const fs::path& file) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream text(file);
  for (std::string line; std::getline(text, line);) {
    std::istringstream cells(line);
    std::vector<std::string>& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

/// Runs a script of Debian's Python in the folder.
Outcome python(const TemporaryFolder& folder, const std::string& script) {
  std::ofstream(folder.path() / "script.py") << script;
  return shell("cd " + folder.path().string() + " && /usr/bin/python3 script.py");
}

TEST(ExportCommand, WritesACsvRowForEachBodyWithTheCountsOfTheRun) {
  const TemporaryFolder folder;
  record(folder);
  ASSERT_EQ(export_run(folder, "--out " + (folder / "a.csv")).exit_code, 0);
  std::map<std::string, int> awake;
  for (const auto& row : rows_of(folder.path() / "a.csv"))
    if (row[0] != "step") awake[row[0]] += row[4] == "0" ? 1 : 0;
  EXPECT_EQ(awake.size(), 150U);
  int compared = 0;
  for (const auto& row : rows_of(folder.path() / "run" / "frames.csv")) {
    if (!awake.contains(row[0])) continue;
    EXPECT_EQ(std::to_string(awake[row[0]]), row[3]) << "step " << row[0];
    ++compared;
  }
  EXPECT_EQ(compared, 150);
}

TEST(ExportCommand, WritesTheColumnsAndArraysThatAreDocumented) {
  const TemporaryFolder folder;
  record(folder);
  ASSERT_EQ(export_run(folder, fmt::format("--out {} --out {}", folder / "a.csv", folder / "a.npz")).exit_code, 0);
  Names columns;
  const auto rows = rows_of(folder.path() / "a.csv");
  for (const std::string& name : rows.front()) columns.insert(name);
  for (const char* of_3d : {"y_m", "qw", "qx", "qy", "qz"}) columns.insert(of_3d);
  expect_documented(columns, "talus export to CSV");
  Names arrays;
  const std::string bytes = contents(folder.path() / "a.npz");
  for (std::size_t at = bytes.find("PK\x01\x02"); at != std::string::npos; at = bytes.find("PK\x01\x02", at + 4)) {
    std::uint16_t length = 0;
    std::memcpy(&length, bytes.data() + at + 28, 2);
    arrays.insert(bytes.substr(at + 46, length - 4U));
  }
  expect_documented(arrays, "talus export to NPZ");
}

/// Two discs on the ground that never sleep, 1 m wide and of density 1000.
TEST(ExportCommand, WritesACsvRowForEachContactThatCarriesTheWeightOfItsBody) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "scene.toml")
      << "title = \"two discs\"\ndimension = 2\nrun = {frames = 60, contacts = true}\npolicy.kind = \"full\"\n"
         "shape.disc = {kind = \"ball\", radius = 0.5, density = 1000}\n"
         "[[source]]\ncount = 2\nspread = [3, 0]\nposition = [0, 1]\n";
  ASSERT_EQ(talus_command("run " + (folder / "scene.toml") + " --no-telemetry --out " + (folder / "run")).exit_code, 0);
  ASSERT_EQ(export_run(folder, "--out " + (folder / "a.contacts.csv")).exit_code, 0);
  const auto rows = rows_of(folder.path() / "a.contacts.csv");
  Names columns(rows.front().begin(), rows.front().end());
  for (const char* of_3d : {"y_m", "normal_y_N", "friction_y_N"}) columns.insert(of_3d);
  expect_documented(columns, "talus export to contacts.csv");
  ASSERT_GE(rows.size(), 3U);
  constexpr double weight = 1000.0 * 0.25 * M_PI * 9.81;  // a disc is 1 m deep
  for (const auto& row : {rows[rows.size() - 2], rows.back()}) {
    EXPECT_EQ(row[3], "-1") << "the ground";
    EXPECT_EQ(row[4], "0") << "awake";
    EXPECT_NEAR(std::stod(row[8]), weight, 0.01 * weight) << "at rest but for the engine's tolerance";
  }
}

TEST(ExportCommand, WritesArraysThatNumpyReadsWithTheCountsOfTheRun) {
  const TemporaryFolder folder;
  record(folder);
  ASSERT_EQ(export_run(folder, "--out " + (folder / "a.npz")).exit_code, 0);
  const Outcome read = python(folder, R"(
import csv, numpy, zipfile
assert zipfile.ZipFile("a.npz").testzip() is None
run = numpy.load("a.npz")
rows = {int(row["step"]): row for row in csv.DictReader(open("run/frames.csv"))}
awake = (run["present"] & ~run["asleep"]).sum(axis=1)
assert len(awake) == 150
for step, count in zip(run["step"], awake): assert int(rows[step]["awake"]) == count, step
assert run["event_woke"].sum() == sum(int(row["woken"]) for row in rows.values())
assert (~run["event_woke"]).sum() == sum(int(row["slept"]) for row in rows.values())
assert run["position"].shape == (150, len(run["shape"]), 2)
assert list(run["shape_name"]) == [b"L"]
print("good")
)");
  EXPECT_EQ(read.out, "good\n") << read.err;
}

TEST(ExportCommand, WritesAllSleepEventsOfTheChosenTimeHoweverFewFramesItTakes) {
  const TemporaryFolder folder;
  record(folder);
  ASSERT_EQ(export_run(folder, fmt::format("--out {} --from 2 --to 3.7 --every 1000", folder / "a.npz")).exit_code, 0);
  const Outcome read = python(folder, R"(
import csv, numpy
run = numpy.load("a.npz")
assert len(run["step"]) == 1
events = 0
for row in csv.DictReader(open("run/frames.csv")):
    if 120 <= int(row["step"]) <= 222: events += int(row["woken"]) + int(row["slept"])
assert events > 10 and len(run["event_step"]) == events, (events, len(run["event_step"]))
print("good")
)");
  EXPECT_EQ(read.out, "good\n") << read.err;
}

// As the record of a run that was killed.
TEST(ExportCommand, WritesTheSleepEventsAfterTheLastWholeFrame) {
  const TemporaryFolder folder;
  record(folder);
  std::string log = contents(folder.path() / "run" / "run.lcm");
  constexpr std::size_t header = 28;  // of a message in a log, before the name of its channel
  const std::size_t sleep = log.find("TALUS_SLEEP", log.size() / 2);
  const std::size_t end = log.find("TALUS_", sleep + 1);
  std::ofstream(folder.path() / "run" / "run.lcm", std::ios::binary) << log.substr(0, end - header);
  ASSERT_EQ(export_run(folder, "--out " + (folder / "a.npz")).exit_code, 0);
  std::istringstream messages(talus_command("info --messages --channel TALUS_SLEEP " + (folder / "run")).out);
  int events = 0;
  for (std::string line; std::getline(messages, line);)
    events += Json::parse(line)["message"]["event_count"].get<int>();
  const Outcome read = python(folder, "import numpy\nprint(len(numpy.load('a.npz')['event_step']))\n");
  EXPECT_EQ(read.out, fmt::format("{}\n", events)) << read.err;
}

TEST(ExportCommand, WritesMeshesAndSeriesThatVtkReads) {
  const TemporaryFolder folder;
  record(folder);
  const std::string files = "--out " + (folder / "a.pvd");
  ASSERT_EQ(export_run(folder, files + " --every 50").exit_code, 0);
  const Outcome read = python(folder, R"(
import vtk, xml.etree.ElementTree as xml
sets = xml.parse("a.pvd").getroot().findall("Collection/DataSet")
assert len(sets) == 3
reader = vtk.vtkXMLPolyDataReader()
reader.SetFileName(sets[-1].get("file"))
reader.Update()
points = reader.GetOutput()
bodies = points.GetNumberOfPoints()
assert bodies > 10 and points.GetPointData().GetArray("orientation").GetNumberOfComponents() == 4
reader = vtk.vtkXMLPolyDataReader()
reader.SetFileName("a_vtp/shape_0.vtp")
reader.Update()
assert reader.GetOutput().GetNumberOfPolys() == 2, "two pieces of an L"
print("good")
)");
  EXPECT_EQ(read.out, "good\n") << read.err;
}

TEST(ExportCommand, TakesThePartOfTheRunThatIsChosen) {
  const TemporaryFolder folder;
  record(folder);
  ASSERT_EQ(export_run(folder, fmt::format("--out {} --from 2 --to 4 --every 30", folder / "a.csv")).exit_code, 0);
  Names times;
  for (const auto& row : rows_of(folder.path() / "a.csv")) times.insert(row[1]);
  EXPECT_EQ(times, Names({"2.000000", "3.000000", "4.000000", "time_s"}));
}

TEST(ExportCommand, LeavesOutWhatDamageHitAndSaysSo) {
  const TemporaryFolder folder;
  record(folder);
  std::string log = contents(folder.path() / "run" / "run.lcm");
  const std::size_t at = log.find("TALUS_BODIES", log.size() / 2) + 60;
  log[at] = static_cast<char>(log[at] ^ 1);
  std::ofstream(folder.path() / "run" / "run.lcm", std::ios::binary) << log;
  const Outcome outcome = export_run(folder, "--out " + (folder / "a.csv"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("the record is damaged"), std::string::npos) << outcome.err;
}

TEST(ExportCommand, RefusesToWriteOverTheRecordAndTheRunsOwnFiles) {
  const TemporaryFolder folder;
  record(folder);
  const fs::path run = folder.path() / "run";
  fs::create_symlink(run / "run.lcm", folder.path() / "link.csv");
  fs::create_symlink(run / "run.lcm", folder.path() / "link.html");
  fs::create_symlink(run / "run.lcm", folder.path() / "link.webp");
  const std::string before = contents(run / "run.lcm") + contents(run / "frames.csv");
  std::vector<std::string> lines = {"replay " + run.string() + " --out " + (folder / "link.html"),
                                    "film " + run.string() + " --out " + (folder / "link.webp")};
  for (const char* out : {"link.csv", "run/frames.csv", "run/gates.csv", "run/regions.csv", "run/loads.csv",
                          "run/profiles.csv", "run/../run/frames.csv"})
    lines.push_back("export " + run.string() + " --out " + (folder / out));
  for (const std::string& line : lines) {
    const Outcome outcome = talus_command(line);
    EXPECT_EQ(outcome.exit_code, 2) << line;
    EXPECT_NE(outcome.err.find("must be none of the files that a run left"), std::string::npos) << outcome.err;
  }
  EXPECT_TRUE(contents(run / "run.lcm") + contents(run / "frames.csv") == before);
  EXPECT_EQ(export_run(folder, "--out " + (folder / "run/poses.csv")).exit_code, 0);
}

TEST(ExportCommand, ThatFailsLeavesAnOlderFileAsItIsAndNoHalfOne) {
  const TemporaryFolder folder;
  record(folder);
  std::ofstream(folder.path() / "a.npz") << "older";
  std::ofstream(folder.path() / "a.html") << "older";
  const auto entries = [&] { return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()); };
  const auto before = entries();
  for (const std::string& line : {"export --out " + (folder / "a.npz"), "export --out " + (folder / "a.csv"),
                                  "export --out " + (folder / "a.pvd"), "replay --out " + (folder / "a.html")})
    EXPECT_EQ(shell("ulimit -f 4; \"$TALUS\" " + line + " " + (folder / "run")).exit_code, 1) << line;
  EXPECT_EQ(contents(folder / "a.npz"), "older");
  EXPECT_EQ(contents(folder / "a.html"), "older");
  EXPECT_EQ(entries(), before);
}

TEST(ExportCommand, LeavesNoFramesOfALongerSeriesAndNothingElseAway) {
  const TemporaryFolder folder;
  record(folder);
  ASSERT_EQ(export_run(folder, "--out " + (folder / "a.pvd") + " --every 30").exit_code, 0);
  std::ofstream(folder.path() / "a_vtp" / "notes.txt") << "mine";
  ASSERT_EQ(export_run(folder, "--out " + (folder / "a.pvd") + " --every 100").exit_code, 0);
  Names names;
  for (const auto& entry : fs::directory_iterator(folder.path() / "a_vtp")) names.insert(entry.path().filename());
  EXPECT_EQ(names, Names({"frame_000000.vtp", "frame_000001.vtp", "notes.txt", "shape_0.vtp"}));
}

TEST(ExportCommand, RefusesBadOptions) {
  const TemporaryFolder folder;
  record(folder);
  const auto refused = [&](const std::string& options, const std::string& said) {
    const Outcome outcome = export_run(folder, options);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  };
  refused("", "--out");
  refused("--out " + (folder / "a.txt"), "must end in .csv");
  refused("--out " + (folder / "a.vtp"), "must end in .csv, .npz or .pvd");
  refused("--out /no/folder/a.csv", "--out");
  refused("--out " + (folder / "a.csv") + " --from 1000", "--from = 1000, --to = inf: must have a frame of");
  refused("--out " + (folder / "a.csv") + " --every 0", "--every");
  refused("--out " + (folder / "a.contacts.csv"), "must be of a run with run.contacts = true");
  EXPECT_FALSE(fs::exists(folder.path() / "a.csv")) << "nothing is written where something is refused";
}

}  // namespace
}  // namespace talus::export_command_test

#endif

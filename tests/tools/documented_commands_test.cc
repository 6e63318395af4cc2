// The commands in README.md, CONTRIBUTING.md and docs/*.md. Each `talus` line of a page's ```sh blocks runs in the
// order of the page, in a scratch folder with the page's scenes. Lines of other programs are checked: sub-commands of
// ./dev, presets of CMake, files of the repository. In running text each sub-command, option and scene must exist.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/process/process.h"
#include "tests/tools/manual_page.h"

#if defined(TALUS_LCM) && defined(TALUS_BULLET)  // the manual is of the whole command

namespace talus::documented_commands_test {
namespace {

namespace fs = std::filesystem;

/// A command that would run for more than a few seconds, or for ever, and what the test runs in its place.
struct Shortened {
  std::string_view command;
  std::string_view run;
};

constexpr auto shortened = std::to_array<Shortened>({
    {"talus monitor", "talus monitor --seconds 1"},
    {"talus sweep public/hopper_2d --set shape.disc.radius=0.4,0.5,0.6,0.7,0.8 --seeds 8 --out hopper",
     "talus sweep public/hopper_2d --set shape.disc.radius=0.4,0.5 --set run.frames=10 --out hopper"},
    {"talus sweep drop_in_a_pile_2d --set policy.kind=full,adaptive --seeds 8 --out policies",
     "talus sweep drop_in_a_pile_2d --set policy.kind=full,adaptive --set run.frames=10 --seeds 2 --out policies"},
    {R"(talus sweep drop_in_a_pile_2d --seeds 400 --out many --on slurm --sbatch "-p short")",
     "talus sweep drop_in_a_pile_2d --seeds 2 --set run.frames=10 --out many"},
    {"talus view drop_in_a_pile_2d", "talus view drop_in_a_pile_2d --seconds 1"},
    {"talus view discs.toml", "talus view discs.toml --seconds 1"},
    {"talus view --live", "talus view --live --seconds 1"},
    {"talus view drop_in_a_pile_2d --against full", "talus view drop_in_a_pile_2d --against full --seconds 1"},
    {"talus view runs/pour runs/full", "talus view runs/pour runs/full --seconds 1"},
    {"talus view runs/pour", "talus view runs/pour --seconds 1"},
    {"talus monitor --plain", "talus monitor --plain --seconds 1"},
    {"talus monitor --json", "talus monitor --json --seconds 1"},
    // It hears no run here, which is a loss.
    {"talus monitor --json --seconds 60 --fail-on-loss", "! talus monitor --json --seconds 1 --fail-on-loss"},
    {"talus bench --preset table1 --quick --out table1",
     "talus bench varying_drops_2d --preset table1 --quick --seeds 1 --set run.frames=20 --out table1"},
    {"talus bench drop_in_a_pile_2d --policy full,adaptive,reference --seeds 8 --out pile",
     "talus bench drop_in_a_pile_2d --policy full,adaptive,reference --seeds 2 --set run.frames=20 --out pile"},
    {"talus bench published --out published", "talus bench published overhang_2d --seeds 1 --out published"},
    {"talus bench --preset table1 --out table1",
     "talus bench varying_drops_2d --preset table1 --quick --seeds 1 --set run.frames=20 --out table1"},
    {"talus bench --preset table1 --set accuracy=fast --out table1_fast",
     "talus bench varying_drops_2d --preset table1 --quick --seeds 1 --set accuracy=fast --set run.frames=20 --out "
     "table1_fast"},
    {"talus bench drop_in_a_pile_2d drop_in_a_pile_3d --policy full,adaptive,reference --seeds 32 --drift --out "
     "example1",
     "talus bench drop_in_a_pile_2d --policy full,reference --seeds 2 --set run.frames=20 --drift --out example1"},
    {"talus bench drop_in_a_pile_2d drop_in_a_pile_3d --policy full,adaptive,reference --set accuracy=fast --seeds 32 "
     "--drift --out fast",
     "talus bench drop_in_a_pile_2d --policy full,adaptive --set accuracy=fast --seeds 1 --set run.frames=20 --out "
     "fast"},
    {"talus bench drop_in_a_pile_2d drop_in_a_pile_3d --policy full,adaptive --set "
     "world.solver.kind=engine,small_steps --seeds 4 --drift --out solvers",
     "talus bench drop_in_a_pile_2d --policy full,adaptive --set world.solver.kind=engine,small_steps --seeds 1 --set "
     "run.frames=20 --drift --out solvers"},
    {"talus bench lab/truth/scenes/*.toml --policy adaptive,reference --set accuracy=fast,standard,fine --seeds 6 "
     "--out levels",
     "talus bench drop_in_a_pile_2d --policy adaptive,reference --set accuracy=fast,standard,fine --seeds 1 --set "
     "run.frames=20 --out levels"},
    {"talus stress", "talus stress stack-5"},
    {"talus stress standing --policy adaptive", "talus stress stack-5 --policy adaptive"},
    {"talus stress --long", "talus stress stack-5 --long"},
});

/// Programs of other projects: their lines are not run.
const std::set<std::string> others = {
    "export", "sqlite3", "lcm-logger", "ip", "sysctl", "git", "build/release/docs/examples/first_pile"};

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool has_talus(const CommandLine& line) { return line.text.starts_with("talus "); }

std::string replaced(const std::string& command) {
  const auto found = std::ranges::find(shortened, command, &Shortened::command);
  return found == shortened.end() ? command : std::string(found->run);
}

/// Runs a line in a folder; messages of runs stay within each process. The exit code is 124 after a minute and a half:
/// such a command needs an entry in `shortened`.
Outcome run_in(const fs::path& folder, const std::string& line) {
  const TemporaryFolder script;
  std::ofstream(script.path() / "line") << line << "\n";
  return shell("export PATH=\"$(dirname \"$TALUS\"):$PATH\" LCM_DEFAULT_URL=memq://\ncd '" + folder.string() +
               "'\ntimeout 90 bash '" + (script.path() / "line").string() + "'");
}

/// What `talus SUB-COMMAND... --help` prints; the words of the line after the last sub-command are in `rest`.
std::string help_for(const std::string& line, std::vector<std::string>& rest) {
  rest = words_of(line);
  rest.erase(rest.begin());
  std::string path;
  std::string help = talus_command("--help").out;
  while (!rest.empty() && help.find("\nSubcommands:") != std::string::npos &&
         std::regex_search(help, std::regex("\n  " + rest.front() + " +[A-Z]"))) {
    path += rest.front() + " ";
    rest.erase(rest.begin());
    help = talus_command(path + "--help").out;
  }
  return help;
}

bool is_scene_name(const std::string& word) { return std::regex_match(word, std::regex("[a-z0-9_]+_[23]d")); }

/// Whether the line's sub-commands, options and scenes exist. Words in capitals stand for anything.
void expect_known(const CommandLine& line) {
  std::vector<std::string> rest;
  const std::string help = help_for(line.text, rest);
  const bool group = help.find("\nSubcommands:") != std::string::npos;
  if (group && !rest.empty() && !rest.front().starts_with("-")) {
    EXPECT_TRUE(std::regex_match(rest.front(), std::regex("[A-Z.]+"))) << "unknown sub-command: " << rest.front();
    return;
  }
  for (const std::string& word : rest) {
    if (std::regex_match(word, std::regex("--?[a-z].*"))) {
      const std::string option = word.substr(0, word.find('='));
      EXPECT_TRUE(std::regex_search(help, std::regex("[\n, ]" + option + "[ ,{\n]"))) << "unknown option: " << option;
    }
    if (is_scene_name(word))
      EXPECT_TRUE(fs::exists(fs::path(TALUS_SOURCE) / "scenes" / (word + ".toml"))) << "unknown scene: " << word;
  }
}

/// The names of the presets of a kind, "configurePresets", "buildPresets" or "testPresets".
std::set<std::string> presets(const std::string& kind) {
  std::set<std::string> names;
  const auto all = nlohmann::json::parse(contents(fs::path(TALUS_SOURCE) / "CMakePresets.json"));
  for (const auto& preset : all.at(kind))
    if (!preset.value("hidden", false)) names.insert(preset.at("name"));
  return names;
}

void expect_preset(const std::vector<std::string>& words) {
  const auto option = std::ranges::find(words, "--preset");
  if (option == words.end()) return;
  ASSERT_NE(option + 1, words.end());
  const bool builds = std::ranges::find(words, "--build") != words.end();
  const std::string kind = words.front() == "ctest" ? "testPresets" : builds ? "buildPresets" : "configurePresets";
  EXPECT_TRUE(presets(kind).contains(*(option + 1))) << "unknown preset: " << *(option + 1);
}

/// `./dev SUB-COMMAND [ARGUMENT]`: the sub-command is in its help, a preset or a fuzz target exists.
void expect_dev(const std::vector<std::string>& words) {
  ASSERT_GE(words.size(), 2U);
  const std::string help = shell("./dev help").out;
  EXPECT_TRUE(std::regex_search(help, std::regex("\n  " + words[1] + "[ \n]"))) << "unknown: ./dev " << words[1];
  if (words.size() == 2 || std::isupper(words[2].front()) != 0) return;
  if (words[1] == "build") EXPECT_TRUE(presets("buildPresets").contains(words[2])) << words[2];
  if (words[1] == "fuzz")
    EXPECT_TRUE(fs::exists(fs::path(TALUS_SOURCE) / "tests/fuzz" / (words[2] + "_fuzz.cc"))) << words[2];
}

/// Words such as docs/scenes.md or .ci/run: files of the repository.
void expect_files(const std::vector<std::string>& words) {
  for (const std::string& word : words)
    if (std::regex_match(word, std::regex("(\\.ci|docs|scenes|tests|tools|common)/[A-Za-z0-9_./]+")))
      EXPECT_TRUE(fs::exists(fs::path(TALUS_SOURCE) / word)) << "no such file: " << word;
}

void expect_other_program(const CommandLine& line) {
  const std::vector<std::string> words = words_of(line.text);
  if (words.empty() || others.contains(words.front())) return;
  const std::set<std::string> programs = {"./dev", "bash", "sh", "cmake", "ctest"};
  ASSERT_TRUE(programs.contains(words.front())) << "neither run nor checked: " << line.text;
  if (words.front() == "./dev") expect_dev(words);
  expect_preset(words);
  expect_files(words);
}

class DocumentedCommands : public ::testing::TestWithParam<std::string> {};

TEST_P(DocumentedCommands, RunInTheOrderOfThePage) {
  const ManualPage page = read_page(GetParam());
  const TemporaryFolder folder;
  for (const auto& [file, toml] : page.files) std::ofstream(folder.path() / file) << toml;
  for (const CommandLine& line : page.commands) {
    SCOPED_TRACE(line.place + ": " + line.text);
    if (!has_talus(line)) {
      expect_other_program(line);
      continue;
    }
    expect_known(line);
    const Outcome outcome = run_in(folder.path(), replaced(line.text));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err << (outcome.exit_code == 124 ? "It took too long: shorten it." : "");
  }
}

std::string name_of_page(const ::testing::TestParamInfo<std::string>& info) {
  return std::regex_replace(fs::path(info.param).stem().string(), std::regex("[^A-Za-z0-9]"), "_");
}

INSTANTIATE_TEST_SUITE_P(Manual, DocumentedCommands, ::testing::ValuesIn(page_names()), name_of_page);

TEST(CommandsInText, HaveSubCommandsOptionsAndScenesThatExist) {
  for (const std::string& name : page_names()) {
    for (const CommandLine& line : read_page(name).inline_commands) {
      SCOPED_TRACE(line.place + ": " + line.text);
      has_talus(line) ? expect_known(line) : expect_dev(words_of(line.text));
    }
  }
}

TEST(CommandsInText, StandInBlocksMarkedAsShellWhereTheyHaveALineOfTheirOwn) {
  for (const std::string& name : page_names())
    for (const CommandLine& line : read_page(name).outside) ADD_FAILURE() << line.place << ": " << line.text;
}

TEST(ShortenedCommands, AreAllInTheManual) {
  std::set<std::string> all;
  for (const std::string& name : page_names())
    for (const CommandLine& line : read_page(name).commands) all.insert(line.text);
  for (const Shortened& each : shortened) EXPECT_TRUE(all.contains(std::string(each.command))) << each.command;
}

TEST(ReadmeProgram, IsTheExampleThatIsCompiled) {
  const std::string program = contents(fs::path(TALUS_SOURCE) / "docs/examples/first_pile.cc");
  const std::string block = "```cpp\n" + program.substr(program.find("#include")) + "```\n";
  EXPECT_NE(contents(fs::path(TALUS_SOURCE) / "README.md").find(block), std::string::npos);
}

TEST(HelpTexts, NameSubCommandsOptionsAndScenesThatExist) {
  for (const char* command : {"run", "check", "new", "list", "reference", "sweep", "bench", "stress", "compare", "film",
                              "replay", "export", "info", "view", "decompose", "monitor"}) {
    std::istringstream help(talus_command(std::string(command) + " --help").out);
    for (std::string line; std::getline(help, line);) {
      const std::size_t begin = line.find("talus ");
      const bool example = line.starts_with("Example: ") || line.starts_with("  talus ");
      if (!example || begin == std::string::npos) continue;
      SCOPED_TRACE(line);
      expect_known({command, line.substr(begin)});
    }
  }
}

TEST(HelpOfDev, NamesPresetsThatExist) {
  std::istringstream help(shell("./dev help").out);
  for (std::string line; std::getline(help, line);) {
    const std::vector<std::string> words = words_of(line.substr(0, line.find(" #")));
    if (words.empty() || (words.front() != "cmake" && words.front() != "ctest")) continue;
    SCOPED_TRACE(line);
    expect_preset(words);
  }
}

}  // namespace
}  // namespace talus::documented_commands_test

#endif

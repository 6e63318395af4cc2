// What the command says about its own command line: suggestions, completion, manual page, and a scene to begin with.

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "tests/process/process.h"

namespace talus::command_line_text_test {
namespace {

void expect_suggestion(const std::string& arguments, const std::string& meant) {
  const Outcome outcome = talus_command(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << arguments;
  EXPECT_NE(outcome.err.find("did you mean \"" + meant + "\"?"), std::string::npos) << arguments << "\n" << outcome.err;
}

TEST(CommandLine, WithAWrongWordSuggestsTheNearest) {
  expect_suggestion("chek", "check");
  expect_suggestion("run drop_in_a_pile_2d --polcy full", "--policy");
  expect_suggestion("sweep drop_in_a_pile_2d --seed=3 --out x", "--seeds");
}

TEST(CommandLine, CompletesCommandsOptionsAndScenesInBash) {
  constexpr const char* script = R"bash(
eval "$("$TALUS" reference --completion bash)"
talus() { "$TALUS" "$@"; }
complete_words() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _talus; echo "${COMPREPLY[*]}"; }
complete_words talus ch
complete_words talus run --pol
complete_words talus run drop_in_a_pile_2
complete_words talus bench --pres
)bash";
  const Outcome outcome = shell(script);
  EXPECT_EQ(outcome.out, "check\n--policy\ndrop_in_a_pile_2d\n--preset\n") << outcome.err;
}

TEST(CommandLine, HasAZshCompletionThatBeginsAsZshWants) {
  EXPECT_TRUE(talus_command("reference --completion zsh").out.starts_with("#compdef talus\n"));
}

TEST(CommandLine, HasAManualPageOfAllCommands) {
  const std::string page = talus_command("reference --man").out;
  EXPECT_TRUE(page.starts_with(".TH TALUS 1\n"));
  for (const char* word : {".SS run\n", ".SS bench\n", ".SS sweep\n", "\\fB\\-\\-policy\\fR"})
    EXPECT_NE(page.find(word), std::string::npos) << word;
}

TEST(HelpText, IsOfPlainWords) {
  std::istringstream all(talus_command("reference --completion bash").out);
  std::set<std::string> commands;
  const std::regex command_case("^ +([a-z]+)\\) words=");
  for (std::string line; std::getline(all, line);)
    if (std::smatch match; std::regex_search(line, match, command_case)) commands.insert(match[1]);
  EXPECT_GE(commands.size(), 14U);
  for (const std::string& command : commands) {
    const std::string help = talus_command(command + " --help").out;
    for (const char* sign : {"{", " in [", ":INT", "FLOAT", "UINT", "REQUIRED", "Excludes", "Needs:", "DIR"})
      EXPECT_EQ(help.find(sign), std::string::npos) << command << ": " << sign << "\n" << help;
  }
  const std::string run = talus_command("run --help").out;
  EXPECT_NE(run.find("--bodies-hz NUMBER"), std::string::npos) << run;
  EXPECT_NE(run.find("0: none (0 to 1000; default 30)"), std::string::npos) << run;
  EXPECT_NE(run.find("(not with --lcm-url)"), std::string::npos) << run;
}

TEST(NewCommand, WritesASceneThatChecksWithoutWarningAndComesToRestInEachDimension) {
  const TemporaryFolder folder;
  for (const char* dimension : {"2", "3"}) {
    const std::string file = folder / (std::string("scene") + dimension);
    EXPECT_EQ(talus_command("new " + file + " --dimension " + dimension).exit_code, 0);
#ifndef TALUS_BULLET
    if (dimension[0] == '3') continue;
#endif
    const Outcome checked = talus_command("check " + file + ".toml");
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
    EXPECT_EQ(checked.err.find("warning"), std::string::npos) << checked.err;
    const Outcome run = talus_command("run " + file + ".toml --strict --no-telemetry --out " + file);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("at rest after"), std::string::npos) << run.out;
  }
}

TEST(NewCommand, OverwritesNothing) {
  const TemporaryFolder folder;
  EXPECT_EQ(talus_command("new " + (folder / "scene")).exit_code, 0);
  const std::string before = contents(folder.path() / "scene.toml");
  const Outcome again = talus_command("new " + (folder / "scene.toml") + " --dimension 3");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_EQ(contents(folder.path() / "scene.toml"), before);
}

}  // namespace
}  // namespace talus::command_line_text_test

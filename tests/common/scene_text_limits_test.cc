#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <fstream>

#include "common/scene/read_scene.h"
#include "common/scene/text_limits.h"
#include "tests/common/temporary_folder.h"

namespace talus::scene_text_limits_test {
namespace {

const std::string untitled = "dimension = 2\n[shape.L]\nkind = \"L\"\n[[source]]\nposition = [0.0, 10.0]\n";
const std::string sound = "title = \"A scene\"\n" + untitled;

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

/// What the reader says of the text; empty if it is a scene.
std::string error_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    parse_scene(text, "a.toml", overrides);
  } catch (const SceneErrors& errors) {
    return errors.what();
  }
  return "";
}

double processor_seconds_to_refuse(const std::string& text) {
  const std::clock_t start = std::clock();
  EXPECT_NE(error_of(text), "");
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

const std::string parts_rule = "parts of a dotted name must be at most 8";
const std::string nesting_rule = "arrays and tables inside each other must be at most 8";

TEST(SceneText, OfFiftyThousandNestedTableNamesIsRefused) {
  const std::string name = "a" + repeated(".a", 50'000);
  EXPECT_EQ(error_of(sound + "[" + name + "]\n"), "a.toml:7:17: " + parts_rule);
  EXPECT_EQ(error_of(sound + name + " = 1\n"), "a.toml:7:16: " + parts_rule);
  EXPECT_EQ(error_of(sound + "x = {" + name + " = 1}\n"), "a.toml:7:21: " + parts_rule);
  EXPECT_EQ(error_of(sound + "\"a\"" + repeated(" . 'a'", 50'000) + " = 1\n").substr(0, 9), "a.toml:7:");
}

TEST(SceneText, OfDeeplyNestedArraysAndTablesIsRefused) {
  EXPECT_EQ(error_of(sound + "x = " + repeated("[", 50'000)), "a.toml:7:13: " + nesting_rule);
  EXPECT_EQ(error_of(sound + "x = " + repeated("{a=", 50'000)), "a.toml:7:29: " + nesting_rule);
}

TEST(SceneText, MayHaveAnyDotsAndBracketsInStringsAndComments) {
  const std::string dots = repeated("a.[{", 100);
  const std::string quotes(3, '"');
  for (const std::string& title : {"\"" + dots + "\"", "'" + dots + "'", "\"\\\"" + dots + "\\\\\" # " + dots,
                                   quotes + "a\"\"" + dots + quotes + " # '", "'''" + dots + "''''"}) {
    EXPECT_EQ(error_of("title = " + title + "\n" + untitled), "") << title;
    EXPECT_EQ(error_of("title = " + title + "\n" + untitled + "[" + repeated("a.", 50'000) + "a]\n"),
              "a.toml:7:17: " + parts_rule)
        << title;
  }
}

TEST(SceneText, LimitsHoldForValuesFromTheCommandLine) {
  const std::string name = repeated("a.", 50'000) + "a";
  EXPECT_TRUE(error_of(sound, {{name + "=1"}}).ends_with(": " + parts_rule));
  EXPECT_TRUE(error_of(sound, {{"run={" + name + "=1}"}}).ends_with(": " + parts_rule));
  EXPECT_TRUE(error_of(sound, {{"title=x\n[" + name + "]"}}).ends_with(": " + parts_rule));
  EXPECT_TRUE(error_of(sound, {{"title=" + repeated("[", 50'000)}}).ends_with(": " + nesting_rule));
  EXPECT_LT(error_of(sound, {{name + "=1"}}).size(), 400U) << "the whole text is in the message";
}

TEST(SceneText, OfMoreThanAMebibyteIsRefusedWithItsSize) {
  const std::string rule = "a scene's text must be at most 1048576 bytes";
  const std::string largest = sound + "#" + std::string(max_scene_text - sound.size() - 1, 'x');
  EXPECT_EQ(error_of(largest), "");
  EXPECT_EQ(error_of(largest + "x"), "a.toml: size = 1048577 bytes: " + rule);
  EXPECT_TRUE(error_of(sound, {{"title=" + std::string(max_scene_text, 'x')}}).starts_with("--set title=xxx"));
  // What a run records must be a scene that can be read again.
  EXPECT_EQ(error_of(sound + "#" + std::string(max_scene_text - sound.size() - 1, 'x'), {{"run.frames=3"}}), "");
  const std::string half(max_scene_text / 2, 'x');
  EXPECT_TRUE(error_of(sound, {{"title=" + half}}).starts_with("the scene with the values of --set: size = 10"));
}

TEST(SceneFile, ThatIsTooLargeOrNeverEndsIsRefusedUnread) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "large.toml";
  std::ofstream(file) << sound;
  std::filesystem::resize_file(file, std::uintmax_t{1} << 40);
  EXPECT_THROW(read_scene(file), SceneErrors);
  EXPECT_THROW(read_scene("/dev/zero"), SceneErrors);
}

TEST(SceneErrorList, PrintsFiftyErrorsAndHowManyMore) {
  std::string text = sound + "[run]\n";
  for (int i = 0; i < 120; ++i) text += "key" + std::to_string(i) + "=1\n";
  const std::string message = error_of(text);
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 50);
  EXPECT_TRUE(message.starts_with("a.toml:8:1: run.key0 = 1: no such key here")) << message;
  EXPECT_TRUE(message.ends_with("\nand 70 more errors")) << message;
}

/// A text of just under a mebibyte: `head`, then as many `lines(0)`, `lines(1)`, ... as it holds.
template <typename Lines>
std::string full_of(const std::string& head, std::size_t size, const Lines& lines) {
  std::string text = head;
  for (int i = 0; text.size() + 300 < size; ++i) text += lines(std::to_string(i));
  return text;
}

// Processor time of the optimised build; the sanitizers and an unoptimised build take up to ten times as long.
#if defined(__SANITIZE_ADDRESS__) || !defined(NDEBUG)
constexpr double a_second = 20.0;
#else
constexpr double a_second = 1.0;
#endif

TEST(SceneErrorList, OfAHundredThousandUnknownKeysTakesLessThanASecond) {
  const auto key = [](const std::string& i) { return "k" + i + "=1\n"; };
  EXPECT_LT(processor_seconds_to_refuse(full_of(sound + "[run]\n", max_scene_text, key)), a_second);
  EXPECT_LT(processor_seconds_to_refuse(full_of("", max_scene_text, key)), a_second);
}

TEST(SceneErrorList, OfAFullTextOfShapesAndSourcesTakesLessThanASecond) {
  const auto shape = [](const std::string& i) { return "[shape.s" + i + "]\n"; };
  const auto long_shape = [](const std::string& i) { return "[shape." + std::string(95, 's') + i + "]\n"; };
  const auto source = [](const std::string&) { return std::string("[[source]]\n"); };
  const auto wrong = [](const std::string&) { return "[[source]]\nshape=\"" + std::string(100, 't') + "\"\n"; };
  const std::string head = "title=''\ndimension=2\n";
  EXPECT_LT(processor_seconds_to_refuse(full_of(full_of(head, max_scene_text / 2, shape), max_scene_text, source)),
            a_second);
  EXPECT_LT(processor_seconds_to_refuse(full_of(full_of(head, 400'000, long_shape), 900'000, wrong)), a_second);
  EXPECT_LT(processor_seconds_to_refuse(full_of(full_of(head, 50'000, shape), 130'000, source)), a_second);
  const std::string long_name = head + "[shape." + std::string(max_scene_text / 2, 's') + "]\n";
  EXPECT_LT(processor_seconds_to_refuse(
                full_of(long_name, max_scene_text, [](const std::string& i) { return "k" + i + "=1\n"; })),
            a_second);
}

}  // namespace
}  // namespace talus::scene_text_limits_test

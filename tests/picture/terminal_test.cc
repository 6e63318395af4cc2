// The pile as text.

#include "tools/picture/terminal.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/picture/sample.h"

namespace talus::terminal_test {
namespace {

constexpr const char* awake_colour = "\x1b[38;5;214m";
constexpr const char* asleep_colour = "\x1b[38;5;244m";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Characters on the screen: bytes that begin a UTF-8 character, outside of escape sequences.
int columns_of(const std::string& line) {
  int columns = 0;
  bool escape = false;
  for (const char c : line) {
    escape = escape || c == '\x1b';
    columns += !escape && (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
    escape = escape && c != 'm';
  }
  return columns;
}

template <int Dim>
void expect_within_limits(const Sample<Dim>& sample) {
  for (const bool colours : {true, false}) {
    for (const TerminalParams params : {TerminalParams{72, 24, colours}, {48, 6, colours}, {200, 10, colours}}) {
      const std::vector<std::string> lines = lines_of(terminal_picture<Dim>(sample.input(), params));
      EXPECT_LE(static_cast<int>(lines.size()), params.rows);
      for (const std::string& line : lines) EXPECT_LE(columns_of(line), params.columns) << line;
    }
  }
}

template <int Dim>
void expect_all_within_limits() {
  Sample<Dim> sample;
  expect_within_limits(sample);
  sample.add_pile(100.0);
  expect_within_limits(sample);
  sample.add_rows(20);
  expect_within_limits(sample);
  sample.add(Vec<Dim>::Constant(1e5), true);
  expect_within_limits(sample);
}

TEST(TerminalPicture, KeepsToRowsAndColumns) {
  expect_all_within_limits<2>();
  expect_all_within_limits<3>();
}

template <int Dim>
void expect_sleeper_left_of_awake() {
  Sample<Dim> sample;
  sample.add(Vec<Dim>::Unit(Dim - 1) * 0.7, true);
  sample.add(Vec<Dim>::Unit(Dim - 1) * 0.7 + Vec<Dim>::Unit(0) * 4.0, false);
  const std::vector<std::string> lines = lines_of(terminal_picture<Dim>(sample.input(), {.colours = true}));
  const std::string& bottom = lines[lines.size() - 3];
  EXPECT_LT(bottom.find(asleep_colour), bottom.find(awake_colour));
  EXPECT_NE(bottom.find(awake_colour), std::string::npos);
  const std::vector<std::string> plain = lines_of(terminal_picture<Dim>(sample.input(), {.colours = false}));
  const std::string& plain_bottom = plain[plain.size() - 3];
  EXPECT_LT(plain_bottom.find("█"), plain_bottom.find("▒"));
  EXPECT_NE(plain_bottom.find("▒"), std::string::npos);
}

TEST(TerminalPicture, ShowsSleepingBodiesWithAndWithoutColours) {
  expect_sleeper_left_of_awake<2>();
  expect_sleeper_left_of_awake<3>();
}

TEST(TerminalPicture, WritesNoEscapeSequenceWithoutColours) {
  Sample<3> sample;
  sample.add_rows(4);
  sample.add_pile(30.0);
  EXPECT_EQ(terminal_picture<3>(sample.input(), {.colours = false}).find('\x1b'), std::string::npos);
}

TEST(TerminalPicture, CountsBodiesInItsLegend) {
  Sample<2> sample;
  sample.add_rows(3);
  sample.add({1e4, 0.0}, true);
  sample.states.removed[1] = 1;
  EXPECT_EQ(lines_of(terminal_picture<2>(sample.input(), {.colours = false})).back(),
            "█ 7 asleep   ▒ 5 awake   1 outside");
}

TEST(TerminalPicture, NamesDensitiesOfLayersThatHoldBodies) {
  Sample<2> sample;
  sample.add_rows(2);
  sample.add_pile(30.0);
  Layer& bottom = sample.piles[0].layers[0];
  bottom.count = 3;
  const std::vector<std::string> lines = lines_of(terminal_picture<2>(sample.input(), {.colours = false}));
  char density[16];
  std::snprintf(density, sizeof density, "%.2f", bottom.density());
  EXPECT_TRUE(
      std::any_of(lines.begin(), lines.end(), [&](const std::string& line) { return line.ends_with(density); }));
}

TEST(TerminalPicture, RefusesSizesByFieldValueAndRule) {
  try {
    terminal_picture<2>(Sample<2>().input(), {.columns = 3});
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "terminal.columns = 3: must be 48 to 400");
  }
}

}  // namespace
}  // namespace talus::terminal_test

#include "common/text/printable.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace talus::printable_test {
namespace {

TEST(Printable, KeepsTextOfAllLanguages) {
  for (const char* text : {"", "400 L shapes", "Haufen größer", "山の石", "🪨 rock", "e\u0301"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ReplacesTerminalCommands) {
  EXPECT_EQ(printable("a\x1b[2Jb\nc\x7f"), "a?[2Jb?c?");
  EXPECT_EQ(printable("\u009b2J"), "?2J") << "C1 has a command introducer too";
  EXPECT_EQ(printable("a\u202eb\u2066c\u2028"), "a?b?c?");
}

TEST(Printable, ReplacesEachByteThatIsNotUtf8) {
  EXPECT_EQ(printable("\xff\xc3"), "??");
  EXPECT_EQ(printable("\xc0\x9b"), "??") << "an overlong form of ESC";
  EXPECT_EQ(printable("\xe0\x82\x9b"), "???");
  EXPECT_EQ(printable("\xed\xa0\x80"), "???") << "a surrogate";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????") << "above the last code";
  EXPECT_EQ(printable("\xe2\x96g"), "??g");
}

TEST(Printable, KeepsLineFeedsOnRequest) { EXPECT_EQ(printable_lines("a\nb\r\x1b"), "a\nb??"); }

RC_GTEST_PROP(PrintableProperty, LeavesNoControlCharacterAndChangesNothingTheSecondTime, (const std::string& text)) {
  const std::string once = printable(text);
  RC_ASSERT(std::none_of(once.begin(), once.end(), [](char c) { return (c >= 0 && c < 0x20) || c == 0x7F; }));
  RC_ASSERT(printable(once) == once);
}

}  // namespace
}  // namespace talus::printable_test

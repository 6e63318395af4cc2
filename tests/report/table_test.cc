#include "tools/report/table.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace talus::table_test {
namespace {

const Table sample{
    "Two engines", {{"engine"}, {"time [ms]", true}}, {{"box2d", "1.5"}, {"größte, \"x\" | y", "12.25"}}};

TEST(TableAsText, PadsByCharactersAndNumbersToTheRight) {
  EXPECT_EQ(text_of(sample),
            "Two engines\n"
            "engine           time [ms]\n"
            "---------------  ---------\n"
            "box2d                  1.5\n"
            "größte, \"x\" | y      12.25\n");
}

TEST(TableAsMarkdown, AlignsNumbersAndKeepsBarsOutOfTheWay) {
  EXPECT_EQ(markdown_of(sample),
            "| engine | time [ms] |\n"
            "| --- | ---: |\n"
            "| box2d | 1.5 |\n"
            "| größte, \"x\" \\| y | 12.25 |\n");
}

TEST(TableAsCsv, QuotesWhatWouldSplitACell) {
  EXPECT_EQ(csv_of(sample),
            "engine,time [ms]\n"
            "box2d,1.5\n"
            "\"größte, \"\"x\"\" | y\",12.25\n");
}

TEST(Table, RefusesARowOfTooFewCells) {
  const Table broken{"", {{"a"}, {"b"}}, {{"1"}}};
  EXPECT_THROW(text_of(broken), std::invalid_argument);
  EXPECT_THROW(markdown_of(broken), std::invalid_argument);
  EXPECT_THROW(csv_of(broken), std::invalid_argument);
}

}  // namespace
}  // namespace talus::table_test

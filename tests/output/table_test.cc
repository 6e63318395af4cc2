#include "tools/output/table.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tools/output/csv.h"

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

TEST(CsvLine, QuotesWhatWouldSplitACell) {
  EXPECT_EQ(csv_line({"größte, \"x\" | y", "12.25"}), "\"größte, \"\"x\"\" | y\",12.25\n");
}

TEST(Table, RefusesARowOfTooFewCells) {
  const Table broken{"", {{"a"}, {"b"}}, {{"1"}}};
  EXPECT_THROW(text_of(broken), std::invalid_argument);
}

}  // namespace
}  // namespace talus::table_test

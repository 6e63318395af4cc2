// The design of `talus bench truth`.

#include "tools/bench/covering_design.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <stdexcept>

namespace talus::covering_design_test {
namespace {

using Design = std::vector<std::vector<int>>;

std::size_t distinct_pairs(const Design& design, std::size_t a, std::size_t b) {
  std::set<std::pair<int, int>> pairs;
  for (const std::vector<int>& row : design) pairs.emplace(row[a], row[b]);
  return pairs.size();
}

void expect_all_pairs(const Design& design, const std::vector<int>& values) {
  for (std::size_t a = 0; a < values.size(); ++a)
    for (std::size_t b = a + 1; b < values.size(); ++b)
      EXPECT_EQ(distinct_pairs(design, a, b), static_cast<std::size_t>(values[a] * values[b])) << a << " and " << b;
}

TEST(CoveringDesign, EveryPairOfValuesOccurs) {
  const std::vector<int> values = {2, 5, 8, 4, 4, 3};
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Design design = covering_design(values, 60, seed);
    ASSERT_EQ(design.size(), 60U);
    expect_all_pairs(design, values);
  }
}

TEST(CoveringDesign, NeedsLittleMoreRowsThanTheLargestPairOfFactorsHas) {
  const std::vector<int> values = {2, 5, 8, 4, 4, 3};
  expect_all_pairs(covering_design(values, 45, 1), values);
}

TEST(CoveringDesign, FurtherRowsEvenOutHowOftenValuesOccur) {
  const Design design = covering_design(std::vector<int>{2, 5, 8, 4, 4, 3}, 60, 1);
  std::array<int, 8> counts{};
  for (const std::vector<int>& row : design) ++counts.at(static_cast<std::size_t>(row[2]));
  for (const int count : counts) {
    EXPECT_GE(count, 6);
    EXPECT_LE(count, 9);
  }
}

TEST(CoveringDesign, TheSeedDecidesTheDesign) {
  const std::vector<int> values = {2, 5, 8, 4, 4, 3};
  EXPECT_EQ(covering_design(values, 20, 7), covering_design(values, 20, 7));
  EXPECT_NE(covering_design(values, 20, 7), covering_design(values, 20, 8));
}

TEST(CoveringDesign, FactorsWithoutValuesAreRefused) {
  EXPECT_THROW(covering_design(std::vector<int>{3}, 5, 1), std::invalid_argument);
  EXPECT_THROW(covering_design(std::vector<int>{3, 0}, 5, 1), std::invalid_argument);
}

}  // namespace
}  // namespace talus::covering_design_test

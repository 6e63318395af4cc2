#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace talus {

/// A table in which each row gives every factor one of its values, and every pair of values of two factors occurs in
/// some row, where `rows` suffice for that. Factor f has the values 0 .. values[f] - 1.
///
/// Greedy: each row is the best of 50 candidates. A candidate begins with one of the rarest pairs so far and gives the
/// other factors, in random order, the value whose pairs with the chosen ones are rarest. So the first rows cover the
/// most pairs, and rows beyond the last uncovered pair even out how often each occurs. The same seed gives the same
/// table on every machine. Throws std::invalid_argument for fewer than two factors or a factor without values.
std::vector<std::vector<int>> covering_design(std::span<const int> values, int rows, std::uint64_t seed);

}  // namespace talus

#pragma once
// Rows in an order that lets the processor work on several at a time.

#include <cstdint>
#include <span>
#include <vector>

namespace talus::bullet {

/// The bodies of a row in the order in which Bullet solves the rows.
struct RowBodies {
  std::int32_t a;
  std::int32_t b;
};

/// Sorts rows by level: a row stands one level above the highest earlier row with which it shares a moving body. Rows
/// of one level depend on none of each other, so their order is free; of two rows that share a body the earlier stays
/// the earlier. So all results keep their bits, and a row need not wait for the one before it.
class RowOrder {
 public:
  /// place[i]: where row i of `rows` goes. `bodies`: how many there are; `fixed`: the one that never moves, or -1.
  void sort(std::span<const RowBodies> rows, int bodies, std::int32_t fixed, std::vector<std::int32_t>& place);

 private:
  std::vector<std::int32_t> reached_;  // by body: level of the next row that it takes part in
  std::vector<std::int32_t> starts_;   // by level: the place of its next row
};

/// The order in which Bullet has them.
void keep_order(std::size_t rows, std::vector<std::int32_t>& place);

}  // namespace talus::bullet

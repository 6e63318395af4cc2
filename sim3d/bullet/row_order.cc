#include "sim3d/bullet/row_order.h"

#include <algorithm>
#include <numeric>

namespace talus::bullet {

void RowOrder::sort(std::span<const RowBodies> rows, int bodies, std::int32_t fixed, std::vector<std::int32_t>& place) {
  reached_.assign(bodies, 0);
  starts_.assign(1, 0);
  place.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::int32_t& a = reached_[rows[i].a];
    std::int32_t& b = reached_[rows[i].b];
    const std::int32_t level = std::max(a, b);
    place[i] = level;
    a = rows[i].a == fixed ? 0 : level + 1;
    b = rows[i].b == fixed ? 0 : level + 1;
    if (std::ssize(starts_) < level + 2) {
      starts_.push_back(0);
    }
    ++starts_[level + 1];
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  for (std::int32_t& each : place) {
    each = starts_[each]++;
  }
}

void keep_order(std::size_t rows, std::vector<std::int32_t>& place) {
  place.resize(rows);
  std::iota(place.begin(), place.end(), 0);
}

}  // namespace talus::bullet

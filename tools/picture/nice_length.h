#pragma once

#include <algorithm>
#include <cmath>

namespace talus {

/// The largest of 1, 2, 5 times a power of ten that is at most `limit` (> 0): the length of a scale bar.
inline double nice_length(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  const double share = limit / power;
  return power * (share >= 5.0 ? 5.0 : share >= 2.0 ? 2.0 : 1.0);
}

}  // namespace talus

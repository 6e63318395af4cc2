#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "common/math/require.h"
#include "common/math/vector.h"

namespace talus {

/// Throws InvalidValue on the first number of a vector or matrix that is not finite, as "FIELD[2] = nan".
template <class Numbers>
void require_finite(const Numbers& numbers, std::string_view field) {
  if (numbers.allFinite()) return;
  for (Eigen::Index i = 0; i < numbers.size(); ++i)
    require(std::isfinite(numbers(i)), fmt::format("{}[{}]", field, i), numbers(i), "must be finite");
}

}  // namespace talus

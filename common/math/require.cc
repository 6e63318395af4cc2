#include "common/math/require.h"

#include <fmt/format.h>

#include <stdexcept>

namespace talus {

void require(bool holds, std::string_view field, double value, std::string_view rule) {
  if (!holds) {
    throw std::invalid_argument(fmt::format("{} = {}: {}", field, value, rule));
  }
}

void require(bool holds, std::string_view field, const std::string& value, std::string_view rule) {
  if (!holds) {
    throw std::invalid_argument(fmt::format("{} = {}: {}", field, value, rule));
  }
}

}  // namespace talus

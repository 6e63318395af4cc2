#include "common/math/require.h"

#include <fmt/format.h>

#include <utility>

namespace talus {

InvalidValue::InvalidValue(std::string field, std::string value, std::string rule)
    : std::invalid_argument(fmt::format("{} = {}: {}", field, value, rule)),
      field_(std::move(field)),
      value_(std::move(value)),
      rule_(std::move(rule)) {}

void refuse(std::string_view field, double value, std::string_view rule) {
  throw InvalidValue(std::string(field), fmt::format("{}", value), std::string(rule));
}

void require(bool holds, std::string_view field, const std::string& value, std::string_view rule) {
  if (!holds) throw InvalidValue(std::string(field), value, std::string(rule));
}

}  // namespace talus

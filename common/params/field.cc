#include "common/params/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <numbers>

namespace talus {

double as_written(const Key& key, double kept) {
  if (key.stored == Stored::as_written) return kept;
  const double converted = key.stored == Stored::in_radians ? kept * 180.0 / std::numbers::pi : 1.0 / kept;
  return std::strtod(fmt::format("{:.15g}", converted).c_str(), nullptr);
}

double as_kept(const Key& key, double written) {
  if (key.stored == Stored::in_radians) return written * std::numbers::pi / 180.0;
  return key.stored == Stored::as_inverse ? 1.0 / written : written;
}

void check_numbers(const Key& key, std::span<const double> kept, const Range& range, std::string_view path) {
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const double written = as_written(key, kept[i]);
    const std::string index = kept.size() > 1 ? fmt::format("[{}]", i) : "";
    require(range.holds(written), fmt::format("{}.{}{}", path, key.name, index), written, range.rule());
  }
}

void check_choice(const Key& key, const std::string& text, std::string_view path) {
  if (key.choices.empty()) return;
  require(std::ranges::find(key.choices, text) != key.choices.end(), fmt::format("{}.{}", path, key.name),
          fmt::format("\"{}\"", text), fmt::format("must be one of {}", fmt::join(key.choices, ", ")));
}

}  // namespace talus

#include "common/params/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "common/math/angle.h"

namespace talus {
namespace {

template <typename T>
void add_numbers(const T& value, std::vector<double>& numbers) {
  if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
    numbers.push_back(static_cast<double>(value));
  } else if constexpr (requires { value.has_value(); }) {
    if (value) add_numbers(*value, numbers);
  } else if constexpr (!std::is_same_v<T, bool> && !std::is_same_v<T, std::string>) {
    for (const auto& part : value) add_numbers(part, numbers);
  }
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

}  // namespace

std::string Range::rule() const {
  const Range any;
  const bool bounded_below = low > any.low;
  const bool bounded_above = high < any.high;
  if (!bounded_below && !bounded_above) return "must be finite";
  std::string text = "must be ";
  if (bounded_below) text += fmt::format("{} {}", low_excluded ? "above" : "at least", low);
  if (bounded_above)
    text += fmt::format("{}{} {}", bounded_below ? " and " : "", high_excluded ? "below" : "at most", high);
  return text;
}

double as_written(const Key& key, double kept) {
  if (key.stored == Stored::as_written) return kept;
  const double converted = key.stored == Stored::in_radians ? in_degrees(kept) : 1.0 / kept;
  const std::string text = fmt::format("{:.15g}", converted);
  double rounded = converted;
  std::from_chars(text.data(), text.data() + text.size(), rounded);  // strtod follows the program's locale
  return rounded;
}

double as_kept(const Key& key, double written) {
  if (key.stored == Stored::in_radians) return in_radians(written);
  return key.stored == Stored::as_inverse ? 1.0 / written : written;
}

ConstValue read_only(const Value& value) {
  return std::visit(
      [](auto where) {
        if constexpr (std::is_same_v<decltype(where), std::monostate>)
          return ConstValue();
        else
          return ConstValue(std::in_place_type<const std::remove_pointer_t<decltype(where)>*>, where);
      },
      value);
}

std::vector<double> numbers_of(const ConstValue& value) {
  std::vector<double> numbers;
  const auto add = [&](auto where) {
    if constexpr (!std::is_same_v<decltype(where), std::monostate>) add_numbers(*where, numbers);
  };
  std::visit(add, value);
  return numbers;
}

void check_value(const Key& key, const ConstValue& value, const Range& range, std::string_view path) {
  check_numbers(key, numbers_of(value), range, path);
  if (const auto* text = std::get_if<const std::string*>(&value)) check_choice(key, **text, path);
}

}  // namespace talus

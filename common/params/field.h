#pragma once
// How a parameter struct declares its fields. The reader of scene files, check() and the tables of docs/scenes.md all
// come from these declarations; a parameter is written nowhere else.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "common/math/require.h"
#include "common/math/vector.h"
#include "common/params/range.h"

namespace talus {

/// How a struct keeps a number of a scene file.
enum class Stored { as_written, in_radians, as_inverse };

/// A key of a scene file. An empty member does not apply to the key.
struct Key {
  std::string_view name;
  /// Earlier name, which is still read, with a warning.
  std::string_view old_name = {};
  bool required = false;
  /// 2 or 3: the key has a meaning in scenes of this dimension only.
  int dimension = 0;
  /// Why it has none in the other dimension, for the error.
  std::string_view elsewhere = {};
  /// For the manual, where the type of the member is too general: "point".
  std::string_view type = {};
  std::string_view unit = {};
  Stored stored = Stored::as_written;
  /// Values of each number, in `unit`.
  Range range = {};
  /// Field of the same struct, declared before, whose value is the lower end of the range.
  std::string_view not_below = {};
  /// Texts that a text may be.
  std::span<const std::string_view> choices = {};
  /// For the manual: a rule besides the range, which the code that uses the field checks.
  std::string_view further_rule = {};
  /// For the manual, where no constant says it; else the member's default is taken.
  std::string_view default_text = {};
  /// What it does and what goes wrong with a bad value. Markdown.
  std::string_view meaning = {};
};

/// A member of a struct; none for a key that code of its own reads and that is declared for the manual only.
template <typename S>
using Member = std::variant<std::monostate, double S::*, int S::*, std::int64_t S::*, std::uint64_t S::*, bool S::*,
                            std::string S::*, std::vector<double> S::*, std::optional<double> S::*,
                            std::optional<bool> S::*, Vec<1> S::*, Vec<2> S::*, Vec<3> S::*, Eigen::Vector2i S::*,
                            Eigen::Vector3i S::*, std::optional<Vec<2>> S::*, std::optional<Vec<3>> S::*,
                            std::vector<Vec<2>> S::*, std::vector<Vec<3>> S::*>;

/// A member with its key.
template <typename S>
struct Field {
  Member<S> member = {};
  Key key;
};

/// All fields of a struct, in the order of the manual.
template <typename S>
using Fields = std::span<const Field<S>>;

/// Calls `visit(key, member)` for each field that has a member.
template <typename S, typename Visitor>
void for_each_field(S& params, std::type_identity_t<Fields<std::remove_const_t<S>>> fields, const Visitor& visit) {
  for (const auto& field : fields) {
    const auto with_member = [&](auto member) {
      if constexpr (!std::is_same_v<decltype(member), std::monostate>) visit(field.key, params.*member);
    };
    std::visit(with_member, field.member);
  }
}

/// A number as it is written in a scene file, from the one that the struct keeps. A conversion is rounded to 15 digits,
/// or 25 degrees would come back as 25.000000000000004.
double as_written(const Key& key, double kept);

/// The number that a struct keeps, from the one in a scene file.
double as_kept(const Key& key, double written);

/// The numbers of a value, as they are kept; none in a flag or a text.
template <typename T>
std::vector<double> numbers_of(const T& value) {
  if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
    return {};
  } else if constexpr (std::is_arithmetic_v<T>) {
    return {static_cast<double>(value)};
  } else if constexpr (requires { value.has_value(); }) {
    return value ? numbers_of(*value) : std::vector<double>();
  } else {
    std::vector<double> numbers;
    for (const auto& part : value)
      for (const double number : numbers_of(part)) numbers.push_back(number);
    return numbers;
  }
}

/// The range of a key; its lower end is the value of `not_below` where that is given.
template <typename S>
Range range_of(const Key& key, const S& params, std::type_identity_t<Fields<S>> fields) {
  Range range = key.range;
  for_each_field(params, fields, [&](const Key& other, const auto& value) {
    if (!key.not_below.empty() && other.name == key.not_below) range.low = numbers_of(value).front();
  });
  return range;
}

/// Throws InvalidValue unless each number is in the range.
void check_numbers(const Key& key, std::span<const double> kept, const Range& range, std::string_view path);
/// Throws InvalidValue unless the text is one of the key's choices.
void check_choice(const Key& key, const std::string& text, std::string_view path);

/// Throws InvalidValue, its field named `path`.KEY, for the first value outside of its range or choices.
template <typename S>
void check_fields(const S& params, std::type_identity_t<Fields<S>> fields, std::string_view path) {
  for_each_field(params, fields, [&](const Key& key, const auto& value) {
    check_numbers(key, numbers_of(value), range_of(key, params, fields), path);
    if constexpr (std::is_same_v<decltype(value), const std::string&>) check_choice(key, value, path);
  });
}

}  // namespace talus

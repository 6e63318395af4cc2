#pragma once
// How a parameter struct declares its fields. The reader of scene files, check() and the tables of docs/scenes.md all
// come from these declarations; a parameter is written nowhere else.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "common/math/require.h"
#include "common/math/vector.h"

namespace talus {

/// Values that a number of a scene may have. Never NaN, never infinite.
struct Range {
  double low = std::numeric_limits<double>::lowest();
  double high = std::numeric_limits<double>::max();
  bool low_excluded = false;
  bool high_excluded = false;

  constexpr bool holds(double value) const {
    return (low_excluded ? value > low : value >= low) && (high_excluded ? value < high : value <= high);
  }

  /// As in "must be above 0 and at most 1".
  std::string rule() const;
};

constexpr Range at_least(double low) { return {.low = low}; }
constexpr Range between(double low, double high) { return {.low = low, .high = high}; }
/// Without `low` itself.
constexpr Range above(double low, double high) { return {.low = low, .high = high, .low_excluded = true}; }
/// From 0 on, without `high` itself.
constexpr Range below(double high) { return {.low = 0.0, .high = high, .high_excluded = true}; }

/// Of gravity and of each of its components [m/s^2].
inline constexpr Range gravity_range = between(0.0, 1e3);
inline constexpr Range gravity_component_range = between(-gravity_range.high, gravity_range.high);
/// Beyond 10 km from the origin a single-precision engine places bodies a millimetre off.
inline constexpr Range coordinate_range = between(-1e4, 1e4);
/// Sizes of bodies and obstacles; those of the smallest bodies decide the units of the engine (fitting_units()).
inline constexpr Range length_range = between(1e-5, 1e4);
inline constexpr Range spread_range = between(0.0, 1e4);
/// Faster, and a step of 1/60 s is longer than any pile.
inline constexpr Range speed_range = between(-1e3, 1e3);

/// How a struct keeps a number of a scene file.
enum class Stored { as_written, in_radians, as_inverse };

/// A key of a scene file. An empty member does not apply to the key.
struct Key {
  std::string_view name;
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
  /// The choice that a number in `range` stands for; null: there must be a text.
  std::string_view (*choice_of)(double) = nullptr;
  /// For the manual: a rule besides the range, which the code that uses the field checks.
  std::string_view further_rule = {};
  /// For the manual, where no constant says it; else the member's default is taken.
  std::string_view default_text = {};
  /// What it does and what goes wrong with a bad value. Markdown.
  std::string_view meaning = {};
};

/// One of the types that a value may have, or none; `Of<T>`: how it is referred to.
template <template <typename> typename Of>
using OneOf = std::variant<std::monostate, Of<double>, Of<int>, Of<std::int64_t>, Of<std::uint64_t>, Of<bool>,
                           Of<std::string>, Of<std::vector<double>>, Of<std::optional<double>>, Of<std::optional<bool>>,
                           Of<std::optional<std::string>>, Of<Vec<1>>, Of<Vec<2>>, Of<Vec<3>>, Of<Eigen::Vector2i>,
                           Of<Eigen::Vector3i>, Of<std::optional<Vec<2>>>, Of<std::optional<Vec<3>>>,
                           Of<std::vector<Vec<2>>>, Of<std::vector<Vec<3>>>>;

template <typename T>
using Pointer = T*;
template <typename T>
using ConstPointer = const T*;
/// Where a value is. Of no struct in particular, so that what handles values is compiled once.
using Value = OneOf<Pointer>;
using ConstValue = OneOf<ConstPointer>;

/// The same place, to be read only.
ConstValue read_only(const Value& value);

/// Where a struct has a member, named by a pointer to it: place_of<&Material::friction>.
template <auto member, typename S>
Value place_of(S& params) {
  return Value(std::in_place_type<std::remove_reference_t<decltype(params.*member)>*>, &(params.*member));
}

/// A member with its key.
template <typename S>
struct Field {
  /// None for a key that code of its own reads and that is declared for the manual only.
  Value (*place)(S&) = nullptr;
  Key key;
};

/// All fields of a struct, in the order of the manual.
template <typename S>
using Fields = std::span<const Field<S>>;

/// Where the member is; none where the field has none.
template <typename S>
Value value_of(S& params, const Field<S>& field) {
  return field.place == nullptr ? Value() : field.place(params);
}
template <typename S>
ConstValue value_of(const S& params, const Field<S>& field) {
  return read_only(value_of(const_cast<S&>(params), field));  // looked up only
}

/// A number as it is written in a scene file, from the one that the struct keeps. A conversion is rounded to 15 digits,
/// or 25 degrees would come back as 25.000000000000004.
double as_written(const Key& key, double kept);

/// The number that a struct keeps, from the one in a scene file.
double as_kept(const Key& key, double written);

/// The numbers of a value, as they are kept; none in a flag or a text.
std::vector<double> numbers_of(const ConstValue& value);

/// The range of a key; its lower end is the value of `not_below` where that is given.
template <typename S>
Range range_of(const Key& key, const S& params, std::type_identity_t<Fields<S>> fields) {
  Range range = key.range;
  if (key.not_below.empty()) return range;
  for (const Field<S>& other : fields)
    if (other.key.name == key.not_below) range.low = numbers_of(value_of(params, other)).front();
  return range;
}

/// Throws InvalidValue unless each number is in the range and a text is one of the key's choices.
void check_value(const Key& key, const ConstValue& value, const Range& range, std::string_view path);

/// Throws InvalidValue, its field named `path`.KEY, for the first value outside of its range or choices.
template <typename S>
void check_fields(const S& params, std::type_identity_t<Fields<S>> fields, std::string_view path) {
  for (const Field<S>& field : fields)
    check_value(field.key, value_of(params, field), range_of(field.key, params, fields), path);
}

}  // namespace talus

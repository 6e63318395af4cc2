#pragma once

#include <fmt/format.h>

#include <limits>
#include <string>

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
  std::string rule() const {
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
/// Sizes that both engines can simulate; `talus check` warns of those for which contacts are inaccurate.
inline constexpr Range length_range = between(0.01, 1e4);
inline constexpr Range spread_range = between(0.0, 1e4);
/// Faster, and a step of 1/60 s is longer than any pile.
inline constexpr Range speed_range = between(-1e3, 1e3);

}  // namespace talus

#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace talus {

enum class Bound { kept, left_out };

/// For an option: a finite number up to `high`, from or above `low`. CLI::Range lets nan through.
inline CLI::Validator number_between(double low, double high, Bound lower = Bound::kept) {
  const auto check = [=](const std::string& text) -> std::string {
    double value = NAN;
    const bool inside = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value <= high &&
                        (lower == Bound::kept ? value >= low : value > low);
    if (inside) return {};
    return fmt::format("{}: must be a number {} {:g} and at most {:g}", text, lower == Bound::kept ? "from" : "above",
                       low, high);
  };
  return CLI::Validator(check, fmt::format("NUMBER in {}{:g}, {:g}]", lower == Bound::kept ? '[' : '(', low, high));
}

}  // namespace talus

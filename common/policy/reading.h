#pragma once

#include <optional>
#include <string_view>

namespace talus {

/// A number that a policy goes by for one body.
struct Reading {
  std::string_view name;
  double value = 0.0;
  std::optional<double> threshold;  // what `value` is compared with; none: it is only known
  std::string_view unit;            // empty: a plain number
  std::string_view effect;          // of a value above the threshold; of no threshold: what the value says
};

}  // namespace talus

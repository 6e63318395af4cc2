#pragma once

#include <algorithm>
#include <cmath>

namespace talus {

/// The units in which an engine simulates a world. Engines hold contacts best between bodies of about a metre, so a
/// world of much smaller or larger bodies is simulated 4^power times as large and 2^power times as slowly (Froude's
/// scaling): then gravity and all ratios of forces are the same. Powers of two, so nothing is rounded.
struct UnitScale {
  int power = 0;

  /// Of the engine over those of the world.
  double lengths() const { return std::ldexp(1.0, 2 * power); }
  double times() const { return std::ldexp(1.0, power); }
  double speeds() const { return times(); }
  /// Of the steps a second that a world needs: small bodies need more, large ones no fewer.
  double steps() const { return std::max(1.0, times()); }
  bool operator==(const UnitScale&) const = default;
};

}  // namespace talus

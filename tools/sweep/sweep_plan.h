#pragma once
// The runs of a sweep: the product of all values.

#include <string>
#include <utility>
#include <vector>

namespace talus {

/// A key of the scene and the values that it takes in turn.
struct SweepAxis {
  std::string path;
  std::vector<std::string> values;  // as TOML
};

/// One run: a value of each axis, in their order.
struct SweepRun {
  std::vector<std::string> values;
};

/// Most runs of a sweep.
inline constexpr std::size_t most_sweep_runs = 100'000;

/// `PATH=LOW:HIGH:STEP`, both ends included, `PATH=A,B,C`, or `PATH=VALUE`. Commas and colons within brackets and
/// quotes belong to a value. Throws std::invalid_argument with the text and the rule.
SweepAxis sweep_axis(const std::string& text);

/// All combinations, those of the last axis side by side. Throws std::invalid_argument where there are too many.
std::vector<SweepRun> sweep_runs(const std::vector<SweepAxis>& axes);

}  // namespace talus

#pragma once
// The runs of a sweep: the product of all values.

#include <optional>
#include <string>
#include <string_view>
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

/// The number that a whole text is; none where it is no number.
std::optional<double> number_of(std::string_view text);

/// Splits a text at the separators outside of brackets and quotes. At least one part; parts may be empty.
std::vector<std::string> split_outside(std::string_view text, char separator);

/// `PATH=LOW:HIGH:STEP`, both ends included, `PATH=A,B,C`, or `PATH=VALUE`. Commas and colons within brackets and
/// quotes belong to a value. Throws std::invalid_argument with the text and the rule.
SweepAxis sweep_axis(const std::string& text);

/// Whether two values are equal, as texts or as numbers (0.5 and 0.50), so that their runs would be equal.
bool has_twins(std::vector<std::string> values);

/// Whether one of two paths of keys is the other, or begins with it, so that a value of one replaces that of the other.
bool overlap(const std::string& path, const std::string& other);

/// Throws std::invalid_argument where the paths of two axes overlap: runs would not have all values that they tell.
void require_apart(const std::vector<SweepAxis>& axes);

/// Number of all combinations. Throws std::invalid_argument where there are too many.
int sweep_size(const std::vector<SweepAxis>& axes);

/// The combination of this number. From one number to the next the value of the last axis changes first.
SweepRun sweep_run(const std::vector<SweepAxis>& axes, int number);

/// PATH=VALUE for each axis.
std::vector<std::string> settings_of(const std::vector<SweepAxis>& axes, const SweepRun& run);

}  // namespace talus

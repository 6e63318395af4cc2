#pragma once
// One measured row: who ran, and what came of it.

#include <map>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// What a row is about. Two rows of one key measured the same thing in the same build.
struct RowKey {
  std::string scene;
  std::string backend;
  std::string policy;
  std::string settings;  // overrides of the scene file with spaces between; empty: as the scene says
  std::string round;     // number of a timed run, from 1; or which measures: "errors" against the full run at the same
                         // settings, "reference" against the converged one
  std::string version;   // of talus, with its commit

  auto operator<=>(const RowKey&) const = default;
};

/// Numbers by name; the names are those of measure_names(). What was not measured is missing.
using Values = std::map<std::string, double>;

struct Row {
  RowKey key;
  std::string end_hash;  // of a timed run
  Values values;
};

/// All columns of numbers that a row may have, in the order in which files show them.
std::span<const char* const> measure_names();

/// NaN for what was not measured.
double value_of(const Values& values, const std::string& name);

}  // namespace talus

#pragma once
// Runs cases and judges what they measured.

#include <string>
#include <string_view>
#include <vector>

#include "tools/stress/stress_case.h"

namespace talus {

/// How a gate came out.
enum class StressOutcome {
  pass,
  known,    // red, with a reason that the case states
  red,      // outside of its tolerance, for no known reason
  refused,  // the door does not let the case in, rightly
};
std::string_view to_string(StressOutcome outcome);

/// A gate in a cell.
struct StressRow {
  std::string group;
  std::string name;  // of the case
  std::string quantity;
  std::string unit;
  std::string backend;
  std::string policy;
  double measured = 0.0;  // NaN where nothing was
  double reference = 0.0;
  double tolerance = 0.0;
  StressOutcome outcome = StressOutcome::pass;
  double seconds = 0.0;   // processor time of the cell
  std::string note = {};  // known reason, refusal or failure
};

/// What `talus stress` is to run. Empty lists: all.
struct StressChoice {
  /// Names of groups or cases.
  std::vector<std::string> names;
  std::vector<std::string> backends;
  std::vector<std::string> policies;
  /// All cases; else only those of the quick group, and those that are named.
  bool whole = false;
};

/// The cases that are chosen, in their order. Throws std::invalid_argument on a name of neither a group nor a case.
std::vector<const StressCase*> chosen_cases(const StressChoice& choice);

/// Runs the cells of the chosen cases, `jobs` at a time, each in a process of its own. Rows are in the order of the
/// cases, engines and policies.
std::vector<StressRow> run_stress(const StressChoice& choice, int jobs);

/// "closed/ball-20-friction-0.5 on box2d, full: way over theory's = 0.9 must be 1 ± 0.02 (steady acceleration ...)".
std::string complaint(const StressRow& row);

}  // namespace talus

#pragma once
// A case of `talus stress`: what is built, what is measured, and within which limits the result must lie.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// Where a case runs.
struct StressCell {
  std::string backend;
  std::string policy;
};

/// One measured number of a case, and what it must be.
struct StressGate {
  /// What is measured, in a few words.
  std::string_view quantity;
  /// Empty for a ratio or a number of bodies.
  std::string_view unit;
  double reference = 0.0;
  /// The measured value may differ from the reference by this much.
  double tolerance = 0.0;
  /// Why this reference and this tolerance.
  std::string_view why;

  bool holds(double measured) const;
};

/// Measures a case in one cell: a value for each of its gates, in their order.
using StressMeasure = std::function<std::vector<double>(const StressCell&)>;

/// A limit that is known: the cell is red, and this is the reason.
struct KnownLimit {
  std::string_view backend;  // empty: every engine
  std::string_view policy;   // empty: every policy
  std::string_view reason;   // one sentence
};

/// Which cells a case has.
enum class StressPolicies {
  full_only,  // sleep has no part in it
  all,
  deciding,  // paper and adaptive: it is about their parameters
};

struct StressCase {
  std::string_view group;
  std::string name;
  /// What is built, one sentence without a full stop.
  std::string setup;
  std::vector<StressGate> gates = {};
  /// Empty where the case is made for the other dimension.
  StressMeasure in_plane = {};
  StressMeasure in_space = {};
  StressPolicies policies = StressPolicies::full_only;
  /// Part of the quick group, which the tests run.
  bool quick = false;
  /// The scene lies outside of what the door accepts: a refusal is the right result.
  bool may_be_refused = false;
  std::vector<KnownLimit> known = {};

  /// The reason why a cell is known to be red; empty: none is.
  std::string_view known_limit(const StressCell& cell) const;
  const StressMeasure& measure(int dimension) const { return dimension == 2 ? in_plane : in_space; }
};

/// Sets both measures from one generic function object: `template <int Dim> std::vector<double>
/// operator()(const StressCell&) const`.
template <class Measure>
void measure_by(StressCase& stress_case, const Measure& measure) {
  stress_case.in_plane = [measure](const StressCell& cell) { return measure.template operator()<2>(cell); };
  stress_case.in_space = [measure](const StressCell& cell) { return measure.template operator()<3>(cell); };
}

/// The same, as a part of an initialiser.
template <class Measure>
StressCase measured(StressCase stress_case, const Measure& measure) {
  measure_by(stress_case, measure);
  return stress_case;
}

// The groups, in the order of the page.
std::vector<StressCase> closed_form_cases();
std::vector<StressCase> standing_cases();
std::vector<StressCase> granular_cases();
std::vector<StressCase> extreme_cases();
std::vector<StressCase> piling_cases();
std::vector<StressCase> peer_cases();

/// Every case, in the order of the groups.
const std::vector<StressCase>& stress_cases();

/// A group's name, and what its cases have in common, one sentence.
struct StressGroup {
  std::string_view name;
  std::string_view about;
};
const std::vector<StressGroup>& stress_groups();

}  // namespace talus

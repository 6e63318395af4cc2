#pragma once
// Cases that a physics engine under a policy must get right, each inside the window in which its results hold. The
// tests run them, and `talus stress`.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/policy/rest/adaptive_params.h"
#include "common/world/world_description.h"

namespace talus {

/// Where a case runs.
struct PhysicsCell {
  std::string_view backend;
  std::string_view policy;
  std::string_view solver = small_steps_solver;  // with the policy `engine` the engine's own in any case
  int rings = usual_rings;                       // of the policy `adaptive`, with small_steps_solver
};

/// One measured number of a case, and what it must be.
struct PhysicsGate {
  std::string_view quantity;  // in a few words
  std::string_view unit;      // empty for a ratio or a number of bodies
  double reference = 0.0;
  double tolerance = 0.0;  // the measured number may differ from the reference by this much
  std::string_view why;    // this reference and this tolerance

  bool holds(double measured) const;
};

/// Measures a case in one cell: a number for each of its gates, in their order.
using PhysicsMeasure = std::function<std::vector<double>(const PhysicsCell&)>;

struct PhysicsCase {
  std::string_view group;
  std::string name;
  std::string setup;  // what is built, one sentence without a full stop
  std::vector<PhysicsGate> gates;
  std::vector<std::string_view> policies = {"full"};
  /// Cells that the case is not made for; an empty name stands for any. The reason stands beside each.
  std::vector<PhysicsCell> except = {};
  bool slow = false;
  /// Empty where the case is made for the other dimension.
  PhysicsMeasure in_plane = {};
  PhysicsMeasure in_space = {};

  const PhysicsMeasure& measure(int dimension) const { return dimension == 2 ? in_plane : in_space; }
};

inline const std::vector<std::string_view> every_policy = {"full", "engine", "paper", "adaptive"};
/// Those under which a structure at rest falls asleep.
inline const std::vector<std::string_view> sleeping_policies = {"engine", "adaptive"};

/// The case with both measures from one generic function object: `template <int Dim> std::vector<double>
/// operator()(const PhysicsCell&) const`.
template <class Measure>
PhysicsCase measured(PhysicsCase each, const Measure& measure) {
  each.in_plane = [measure](const PhysicsCell& cell) { return measure.template operator()<2>(cell); };
  each.in_space = [measure](const PhysicsCell& cell) { return measure.template operator()<3>(cell); };
  return each;
}

/// The groups, in their order, and every case of them.
std::vector<std::string_view> physics_groups();
const std::vector<PhysicsCase>& physics_cases();

// Motions with a solution in closed form.
std::vector<PhysicsCase> closed_form_cases();
// Structures that stand by the laws of statics.
std::vector<PhysicsCase> standing_cases();
// Heaps and packings against measured laws of granular matter.
std::vector<PhysicsCase> heap_cases();
// Settings, sizes, places and speeds at the edge of the window.
std::vector<PhysicsCase> window_edge_cases();
// Freezing and waking under load: what a policy may break.
std::vector<PhysicsCase> sleeping_cases();

/// A case in a cell.
struct PhysicsTask {
  const PhysicsCase* each = nullptr;
  PhysicsCell cell;
  int dimension = 2;

  std::vector<double> measure() const { return each->measure(dimension)(cell); }
};

/// Every case on every engine of this build under its policies.
std::vector<PhysicsTask> physics_tasks();

/// "stack-5 on box2d, full: shift = 0.3 m must be 0 ± 0.05 (stands by statics)".
std::string sentence(const PhysicsTask& task, const PhysicsGate& gate, double measured);

}  // namespace talus

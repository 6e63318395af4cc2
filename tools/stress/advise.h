#pragma once

#include <string>
#include <vector>

namespace talus {

/// Options of `talus stress --advise SCENE`.
struct AdviceOptions {
  std::string scene;        // file or name
  std::string backend;      // empty: the dimension's first
  std::string policy;       // empty: the scene's
  double tolerance = 0.05;  // of heights, radii and overlaps at the end [D]
  int seeds = 3;            // runs at each setting
  int jobs = 2;
};

/// Runs the scene at half, its own and double steps a second and iterations, compares the piles at the end with those
/// of the finest setting, and prints which settings suffice, which is the cheapest of them, and whether the scene's own
/// is too coarse or wasteful.
void advise(const AdviceOptions& options);

/// What was measured at one setting, against the finest.
struct AdviceRow {
  double steps_per_second = 60.0;
  int iterations = 10;
  bool own = false;           // the scene's
  double centre_off = 0.0;    // height of the centre of mass [D]
  double centre_error = 0.0;  // standard error of that [D]
  double r50_off = 0.0;       // radius that holds half of the bodies [D]
  double r50_error = 0.0;
  double overlap = 0.0;  // depth that 99 % of touching pairs do not exceed [D]
  int warnings = 0;      // kinds, of all runs
  double seconds = 0.0;  // processor time of a run
  bool failed = false;   // a run did not end

  /// Whether the measures lie within the tolerance, and nothing went wrong.
  bool suffices(double tolerance) const;
  /// Whether they lie beyond it by no more than chance explains: within two standard errors of it.
  bool is_open(double tolerance) const;
};

/// The closing sentences: the cheapest setting that suffices, and what the scene's own is compared with it.
std::string advice(const std::vector<AdviceRow>& rows, double tolerance);

}  // namespace talus

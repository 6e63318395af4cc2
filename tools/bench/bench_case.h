#pragma once
// What is run in a benchmark.

#include <string>
#include <vector>

#include "common/scene/read_scene.h"
#include "tools/bench/row_store.h"

namespace talus {

/// One way to run a scene.
struct BenchCase {
  /// File or name. A file runs for its own number of frames, a name of an example of the paper for the paper's.
  std::string scene;
  std::string backend;
  /// A policy, `reference_policy` or `engine_default_policy`.
  std::string policy;
  /// path=value, replaces values of the scene file.
  std::vector<std::string> settings;
  /// Name of the curve that the case is a point of, in a sweep; empty: the policy.
  std::string curve = {};
  /// The swept value, in a sweep over numbers.
  double swept = 0.0;
};

/// Full at settings that are taken for converged (common/measure/rebuild.h).
inline constexpr const char* reference_policy = "reference";
/// The engine's own sleeping at the engine's default settings: what most users run.
inline constexpr const char* engine_default_policy = "engine_default";

/// Whether policies are compared with the case, which is not a policy to be measured itself.
bool is_baseline(const BenchCase& bench_case);

/// Key of the case's rows, but for pass and round.
RowKey key_of(const BenchCase& bench_case);

/// The scene with the case's policy and settings. Throws as read_scene() and find_scene() do.
AnyScene load(const BenchCase& bench_case);

/// Dimension of a scene file, 2 or 3.
int dimension_of(const std::string& scene);

/// Cases that are compared with one another: one scene and engine at one time step and solver setting.
struct BenchGroup {
  /// The full simulation first.
  std::vector<BenchCase> cases;

  const BenchCase& full() const { return cases.front(); }

  /// The first case of this policy, or nullptr.
  const BenchCase* find(const std::string& policy) const;
};

}  // namespace talus

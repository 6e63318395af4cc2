#pragma once
// What is run in a benchmark.

#include <string>
#include <vector>

#include "common/scene/read_scene.h"
#include "tools/bench/row.h"

namespace talus {

/// One way to run a scene.
struct BenchCase {
  std::string scene;                  // file or name
  std::string backend;                // engine
  std::string policy;                 // or "reference" or "shipped"
  std::vector<std::string> settings;  // path=value, replaces values of the scene file
};

inline constexpr const char* reference_policy = "reference";  // full at settings that are taken for converged
inline constexpr const char* shipped_policy = "shipped";      // the engine with its own sleeping and default settings

/// Whether the case is there to be measured against, and not a policy that is measured.
bool is_yardstick(const BenchCase& bench_case);

/// Without a round: fill that in.
RowKey key_of(const BenchCase& bench_case);

/// The scene as the case wants it. Throws as read_scene() and find_scene() do.
AnyScene load(const BenchCase& bench_case);

/// Dimension of a scene file, 2 or 3.
int dimension_of(const std::string& scene);

/// Policies besides full and engine that this build can make.
std::vector<std::string> known_policies();

}  // namespace talus

#pragma once
// Which scenes, engines and policies a benchmark takes.

#include <string>
#include <vector>

#include "tools/bench/bench_case.h"
#include "tools/bench/bench_options.h"

namespace talus {

/// Scene names: the options', else `names`. A name without "_2d" or "_3d" stands for both; `names` that are not
/// installed are left out. Quick: only the first `quick_count` of `names`.
std::vector<std::string> scenes_of(const BenchOptions& options, const std::vector<std::string>& names,
                                   std::size_t quick_count);

/// Engines for the scene: the options' engines of its dimension, else the dimension's first.
std::vector<std::string> backends_of(const BenchOptions& options, const std::string& scene);

/// The options' settings for every case of this scene, with the frames cut to the options' share.
std::vector<std::string> settings_of(const BenchOptions& options, const std::string& scene);

/// Policies to measure beside full and engine: the options', else paper and adaptive.
std::vector<std::string> policies_of(const BenchOptions& options);

/// Full, the engine's sleeping, the policies to measure, and with options.reference the reference, on one scene and
/// engine.
BenchGroup policies_group(const BenchOptions& options, const std::string& scene, const std::string& backend);

}  // namespace talus

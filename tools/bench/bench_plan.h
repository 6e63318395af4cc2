#pragma once
// Which scenes, engines and policies a benchmark takes.

#include <string>
#include <vector>

#include "tools/bench/bench_options.h"
#include "tools/bench/bench_runner.h"

namespace talus {

/// Scene names: those asked for, else `names`. A name without "_2d" or "_3d" stands for both; of `names`, what this
/// checkout does not have is left out. Quick: only the first `quick_count` of `names`.
std::vector<std::string> scenes_of(const BenchOptions& options, const std::vector<std::string>& names,
                                   std::size_t quick_count);

/// Engines for the scene: those asked for that can run it, else the dimension's first.
std::vector<std::string> backends_of(const BenchOptions& options, const std::string& scene);

/// The options' settings for every case of this scene, with the length that `share` asks for.
std::vector<std::string> settings_of(const BenchOptions& options, const std::string& scene);

/// Full, engine sleeping, then the policies asked for (else all known), on one scene and engine; the reference last
/// where it is asked for.
BenchGroup policies_group(const BenchOptions& options, const std::string& scene, const std::string& backend);

}  // namespace talus

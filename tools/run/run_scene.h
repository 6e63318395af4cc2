#pragma once

#include "tools/run/run_options.h"

namespace talus {

/// Executes `talus run`; returns the exit code. Throws SceneErrors and std::invalid_argument on bad
/// input before anything is written.
int run_scene(const RunOptions& options);

}  // namespace talus

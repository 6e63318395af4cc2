#pragma once

#include <CLI/CLI.hpp>

namespace talus {

/// `talus sweep`: a scene with all combinations of values.
void add_sweep_command(CLI::App& app, int& exit_code);

}  // namespace talus

#pragma once

#include <CLI/CLI.hpp>

namespace talus {

/// `talus stress`. Sets `exit_code` when it has run.
void add_stress_command(CLI::App& app, int& exit_code);

}  // namespace talus

#pragma once

#include <CLI/CLI.hpp>

namespace talus {

/// `talus compare RUN_A RUN_B`.
void add_compare_command(CLI::App& app, int& exit_code);

/// `talus film RUN`.
void add_film_command(CLI::App& app, int& exit_code);

/// `talus wake RUN`.
void add_wake_command(CLI::App& app, int& exit_code);

}  // namespace talus

#pragma once

#include <CLI/CLI.hpp>

namespace talus {

/// `talus bench truth`, with options of its own.
void add_truth_command(CLI::App& bench, int& exit_code);

}  // namespace talus

#pragma once

#include <CLI/CLI.hpp>

namespace talus {

/// `talus bench NAME`, a benchmark each.
void add_bench_command(CLI::App& app, int& exit_code);

}  // namespace talus

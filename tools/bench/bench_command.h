#pragma once

#include <CLI/CLI.hpp>

namespace talus {

/// `talus bench`: what policies save in scenes, and by how much their piles are off.
void add_bench_command(CLI::App& app, int& exit_code);

}  // namespace talus

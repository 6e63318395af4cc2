#pragma once

#include <CLI/CLI.hpp>

namespace talus {

/// Adds `decompose`, which makes the convex parts of a mesh file, to the program's sub-commands.
void add_decompose_command(CLI::App& app);

}  // namespace talus

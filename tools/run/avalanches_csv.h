#pragma once

#include <filesystem>
#include <span>

#include "common/measure/avalanches.h"

namespace talus {

/// Writes avalanches.csv, a row each. Throws std::runtime_error where it cannot.
void write_avalanches(const std::filesystem::path& file, std::span<const Avalanche> avalanches);

}  // namespace talus

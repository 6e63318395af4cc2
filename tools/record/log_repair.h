#pragma once

#include <filesystem>

namespace talus {

/// Copies the whole events of a damaged log to run.lcm in the new folder `out`, with the scene.toml that lies beside
/// it, and says what was left out. Throws std::invalid_argument where `out` exists.
void repair_log(const std::filesystem::path& file, const std::filesystem::path& out);

}  // namespace talus

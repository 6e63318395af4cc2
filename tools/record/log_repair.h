#pragma once

#include <filesystem>
#include <string>

namespace talus {

/// Copies the whole events of a log to run.lcm in the new folder `out`, with the scene.toml that lies beside it, and
/// says what was left out. Stamps that lie before an earlier one or far from all others, which make players stand
/// still, become that of the event before. `run`: of the runs in it only this one, as short_id() names it; empty: all.
/// Throws std::invalid_argument where `out` exists, where the log holds no event, and where it has no such run.
void repair_log(const std::filesystem::path& file, const std::string& run, const std::filesystem::path& out);

}  // namespace talus

#pragma once
// What an event log holds.

#include <filesystem>
#include <nlohmann/json.hpp>

namespace talus {

/// Reads a log and counts what is in it, by channel, by run and by the stamps of its events. Keys as in docs/files.md.
/// Throws std::invalid_argument where a file that is not empty holds no event.
nlohmann::ordered_json log_summary(const std::filesystem::path& file);

/// The same for a terminal.
void print_log_summary(const nlohmann::ordered_json& summary);

}  // namespace talus

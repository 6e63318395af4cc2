#pragma once

#include <filesystem>
#include <string>

namespace talus {

/// Writes or replaces a file. Throws std::runtime_error naming it if it cannot be written.
void write_file(const std::filesystem::path& path, const std::string& bytes);

}  // namespace talus

#pragma once
// Whole files.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace talus {

/// What is required of a file that is read.
inline constexpr const char* readable_rule = "must be a regular file that can be read";

/// All bytes of a file; none where it cannot be read or is no regular file, but a folder, a pipe or a device.
std::optional<std::string> file_contents(const std::filesystem::path& file);

/// Makes the file or replaces it. Throws std::runtime_error with its name where it cannot be written.
void write_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace talus

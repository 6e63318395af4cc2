#pragma once

#include <filesystem>
#include <string>

namespace talus {

/// A record as the browser page plays it: the bytes of a zlib stream of a number (four bytes, low byte first), as many
/// bytes of JSON (run_head.h), and one block for each frame of output (frame_stream.h). Damage costs what it hit, and
/// the head says so. Holds the whole in memory. Throws as read_run() does.
std::string record_stream(const std::filesystem::path& folder);

}  // namespace talus

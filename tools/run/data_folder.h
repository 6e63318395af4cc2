#pragma once

#include <filesystem>

namespace talus {

/// A folder of the files that come with talus: share/talus/NAME beside the folder of the running command. It does not
/// depend on the current directory.
std::filesystem::path data_folder(const std::filesystem::path& name);

}  // namespace talus

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// Folder of the scenes that come with talus (data_folder.h).
std::filesystem::path scene_folder();

/// Scene files in that folder, by name.
std::vector<std::filesystem::path> scene_files();

/// `scene` itself if a file has this path, else the file of that name in or below scene_folder(). Throws
/// std::invalid_argument with the nearest name when neither exists.
std::filesystem::path find_scene(const std::string& scene);

}  // namespace talus

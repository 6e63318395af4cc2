#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// Folder of the scenes that come with talus (data_folder.h).
std::filesystem::path scene_folder();

/// Scene files in a folder, by name.
std::vector<std::filesystem::path> scene_files(const std::filesystem::path& folder = scene_folder());

/// `scene` itself if a file has this path, else the file of that name in or below a folder. Throws
/// std::invalid_argument with the nearest name when neither exists.
std::filesystem::path find_scene(const std::string& scene, const std::filesystem::path& folder = scene_folder());

}  // namespace talus

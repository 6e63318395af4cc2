#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// Folder of the scenes that come with talus: ./scenes, else where they were installed or built from.
std::filesystem::path scene_folder();

/// Scene files in that folder, by name.
std::vector<std::filesystem::path> scene_files();

/// `scene` itself if there is such a file, else the scene of that name. Throws std::invalid_argument for neither,
/// naming the nearest.
std::filesystem::path find_scene(const std::string& scene);

}  // namespace talus

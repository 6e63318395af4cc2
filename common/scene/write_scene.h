#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace talus {

/// Name of the scene's own file in a run folder.
inline constexpr const char* scene_file_name = "scene.toml";

/// A file of a scene.
struct SceneFile {
  std::string name;  // its path below the scene's folder
  std::string text;
};

/// The TOML that a scene was read from, overrides put in, as scene.toml, and the files that it names (meshes): reading
/// them gives the same scene. Empty for a scene that was not read from TOML. Throws std::invalid_argument where one of
/// them can no longer be read.
template <int Dim>
std::vector<SceneFile> scene_files(const Scene<Dim>& scene);

/// Writes these files into a folder that exists. Throws std::runtime_error if a file cannot be written,
/// std::invalid_argument where a file lies outside of the folder.
void write_scene_files(const std::vector<SceneFile>& files, const std::filesystem::path& folder);

}  // namespace talus

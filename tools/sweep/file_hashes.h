#pragma once
// Whether scenes are still what they were when their runs began.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "common/scene/read_scene.h"

namespace talus {

/// Hashes of the files that a scene is read from, by their paths relative to the folder of the scene file.
using FileHashes = std::map<std::string, std::string>;

/// Adds those of a scene that was read from `file`: of this file, of those it includes, and of its meshes.
void add_file_hashes(FileHashes& hashes, const std::filesystem::path& file, const AnyScene& scene);

/// Throws std::invalid_argument where one of the files has changed. `began`: what is named in the error, such as "the
/// sweep FOLDER".
void require_unchanged(const FileHashes& hashes, const std::filesystem::path& file, std::string_view began);

}  // namespace talus

#pragma once

#include <filesystem>

#include "common/scene/scene.h"

namespace talus {

/// Writes the TOML that a scene was read from, overrides put in, and beside it the files that it names (meshes), so
/// that reading it gives the same scene. Throws std::runtime_error if a file cannot be written, std::invalid_argument
/// for a scene that was not read from TOML.
template <int Dim>
void write_scene(const Scene<Dim>& scene, const std::filesystem::path& file);

}  // namespace talus

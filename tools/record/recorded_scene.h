#pragma once

#include <filesystem>

#include "common/scene/read_scene.h"
#include "common/scene/setting_differences.h"

namespace talus {

/// The scene of a run folder or of a record without its folder: the one that the record holds, else, where that is
/// damaged, scene.toml beside it. Of a run that a program made without a scene file: shapes, obstacles and as many
/// bodies as the record has. Throws std::invalid_argument where there is none of these, SceneErrors where the scene
/// cannot be read.
AnyScene scene_of_run(const std::filesystem::path& run);

/// The texts of that scene, with defaults by its recorded meshes; empty for a run without a scene file. Throws as
/// scene_of_run() does, but for SceneErrors.
SceneTexts scene_texts_of_run(const std::filesystem::path& run);

}  // namespace talus

#pragma once

#include <filesystem>

#include "common/scene/read_scene.h"

namespace talus {

/// The scene of a run folder or of a record without its folder: the one that the record holds, else, where that is
/// damaged, scene.toml beside it. Throws std::invalid_argument where there is neither, SceneErrors where it cannot be
/// read.
AnyScene scene_of_run(const std::filesystem::path& run);

}  // namespace talus

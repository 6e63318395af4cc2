#pragma once

#include <CLI/CLI.hpp>

#include "tools/run/run_options.h"

namespace talus {

/// Adds what all commands have that read a scene: the scene, --backend, --policy, --set, --seed and --force. `choice`
/// must outlive the command.
void add_scene_options(CLI::App& command, SceneChoice& choice);
/// Those besides the scene itself.
void add_setting_options(CLI::App& command, SceneChoice& choice);

}  // namespace talus

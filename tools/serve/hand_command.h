#pragma once
// What a page does to the bodies of a run by hand.

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/serve/shown_run.h"

namespace talus {

/// Something to do between steps. The text returned says what is wrong; then nothing is done. Empty: done.
using HandCommand = std::function<std::string(ShownRun&)>;

/// What {"do": name} may be.
std::vector<std::string> hand_command_names();
bool is_hand_command(const std::string& name);

/// Reads {"do": "kick", "body": number, "velocity": [m/s]}, {"do": "remove", "body": number}, {"do": "pull", "body":
/// number, "point": [m], "to": [m]}, {"do": "release"}, {"do": "add", "shape": name, "position": [m]} or {"do": "cut",
/// "obstacle": number}. Throws std::invalid_argument with what it must have.
HandCommand read_hand_command(const nlohmann::ordered_json& command);

}  // namespace talus

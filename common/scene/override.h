#pragma once
// Values of a scene file replaced from the command line.

#include <toml++/toml.h>

#include <span>
#include <string>
#include <vector>

#include "common/scene/diagnostics.h"

namespace talus {

/// What follows `--set`: `path=value`, as in `policy.tau=0.4`, `source[0].rate=3`, `run={frames=10}`. The value is read
/// as TOML; what is no TOML is taken for a text, so `policy.kind=full` needs no quotes.
struct Override {
  std::string text;
  std::string origin = {};  // named in errors as the value's place, such as `--seed -1`; empty: `--set TEXT`, shortened
};

/// Puts the overrides' values into the table, in their order. Notes an error for each that has no such form or whose
/// path leads through something that is no table. Whether the scene has such a key shows when the table is read: an
/// error there names the override's origin as its file.
void apply_overrides(toml::table& table, std::span<const Override> overrides, std::vector<SceneError>& errors);

}  // namespace talus

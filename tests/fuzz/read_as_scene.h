#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "common/scene/read_scene.h"
#include "common/scene/warnings.h"
#include "tests/common/scene_description.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/limits.h"

namespace talus::fuzz {

/// Writes the scene and reads it again: it must have the same content.
inline void write_back(const AnyScene& scene) {
  const auto describe = [](const auto& one) { return description(one); };
  const AnyScene again = parse_scene(std::visit([](const auto& one) { return one.toml; }, scene), "text");
  require_that(std::visit(describe, again) == std::visit(describe, scene), "a scene that is written back is the same");
}

/// Reads the text: it must give a scene that can be written back, or errors that each name a file and a rule. Any other
/// exception ends the process. `input` is what the search varies.
inline void read_as_scene(std::string_view input, std::string_view text, std::span<const Override> overrides = {}) {
  const TimeLimit limit;
  try {
    const AnyScene scene = parse_scene(text, "text", overrides);
    if (costly_part_is_due(input)) write_back(scene);
    std::visit([](const auto& one) { (void)warnings(one); }, scene);
  } catch (const SceneErrors& errors) {
    require_that(!errors.errors().empty(), "a refused scene has an error");
    for (const SceneError& error : errors.errors())
      require_that(!error.rule.empty() && !error.file.empty(), "an error names a file and a rule");
  }
}

}  // namespace talus::fuzz

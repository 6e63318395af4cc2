#pragma once
// What an engine does badly or not at all, as measured; docs/scenes.md says how.

#include <limits>
#include <string_view>

namespace talus {

struct EngineTraits {
  std::string_view name;
  double fastest_step = std::numeric_limits<double>::infinity();  // [m] a step: faster bodies are slowed down to it
  // Fall within one step, g dt^2, over the thinnest piece of a shape, above which bodies sink into the ground.
  double sinking_fall = std::numeric_limits<double>::infinity();
  double restitution_gain = 0.0;  // share of energy gained in a minute at a restitution of 1
  double awake_bytes = 0.0;       // memory of one awake body in a heap
  double sleeper_bytes = 0.0;     // memory of one sleeping body
  double awake_seconds = 0.0;     // processor time of a step for one awake body in a heap
};

}  // namespace talus

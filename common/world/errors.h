#pragma once
// What stops a run.

#include <cstdint>
#include <stdexcept>
#include <string>

#include "common/world/body.h"

namespace talus {

/// A body's state became NaN or infinite: the engine's mistake or a scene beyond its limits. The states that the world
/// holds are those before the step, for every body.
class NonFiniteState : public std::runtime_error {
 public:
  NonFiniteState(std::int64_t at_step, BodyIndex broken)
      : std::runtime_error("step " + std::to_string(at_step) + ": the state of body " + std::to_string(broken) +
                           " is not finite; everything up to the step before is kept"),
        step(at_step),
        body(broken) {}
  std::int64_t step;
  BodyIndex body;
};

}  // namespace talus

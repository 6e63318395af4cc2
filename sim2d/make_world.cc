#include "sim2d/make_world.h"

#include <fmt/format.h>

#include "common/math/require.h"
#include "common/world/scaled_world.h"
#include "sim2d/engine_world.h"

namespace talus {
namespace {

/// What only Box2D cannot do.
void check_for_box2d(const WorldDescription<2>& description) {
  require(description.dt >= 1e-6, "world.dt", description.dt,
          "must be at least 1e-6 s: in single precision nothing would move");
  const double fastest_fall = 2.0 / (description.dt * description.dt);
  require(description.gravity <= fastest_fall, "world.gravity", description.gravity,
          fmt::format("must be at most {:.6g} m/s^2: Box2D moves a body by at most 2 m a step", fastest_fall));
}

}  // namespace

EngineTraits box2d_traits() {
  return {.name = "box2d",
          .fastest_step = b2_maxTranslation,
          .awake_bytes = 1200.0,
          .sleeper_bytes = 700.0,
          .awake_seconds = 3e-6};
}

std::unique_ptr<World<2>> make_box2d_world(const WorldDescription<2>& description) {
  return make_in_engine_units<2>(description, [](const WorldDescription<2>& inner) {
    auto world = std::make_unique<box2d::EngineWorld>(inner);  // checks what every engine demands
    check_for_box2d(inner);
    return world;
  });
}

}  // namespace talus

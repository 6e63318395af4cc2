#include "sim3d/make_world.h"

#include "sim3d/engine_world.h"

namespace talus {

std::unique_ptr<World<3>> make_bullet_world(const WorldDescription<3>& description) {
  check(description);
  return std::make_unique<bullet::EngineWorld<3>>(description);
}

std::unique_ptr<World<2>> make_bullet_planar_world(const WorldDescription<2>& description) {
  check(description);
  return std::make_unique<bullet::EngineWorld<2>>(description);
}

}  // namespace talus

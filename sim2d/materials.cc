#include "sim2d/materials.h"

#include <algorithm>
#include <cmath>

namespace talus::box2d {

b2FixtureDef fixture_of(const Material& material, const SolverParams& solver) {
  b2FixtureDef fixture;
  fixture.density = 0.0F;
  fixture.friction = static_cast<float>(material.friction);
  fixture.restitution = static_cast<float>(material.restitution);
  fixture.restitutionThreshold = static_cast<float>(solver.restitution_threshold);
  return fixture;
}

bool restitutions_differ(const WorldDescription<2>& description) {
  std::vector<double> all;
  if (description.ground.present) {
    all.push_back(description.ground.material.restitution);
  }
  for (const auto& obstacle : description.obstacles) {
    all.push_back(obstacle.shape.material.restitution);
  }
  for (const auto& shape : description.shapes) {
    all.push_back(shape.material.restitution);
  }
  return std::ranges::adjacent_find(all, std::ranges::not_equal_to{}) != all.end();
}

void mix_restitution(b2Contact& contact) {
  contact.SetRestitution(std::sqrt(contact.GetFixtureA()->GetRestitution() * contact.GetFixtureB()->GetRestitution()));
}

}  // namespace talus::box2d

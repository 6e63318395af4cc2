#include "common/simulation/energy_ledger.h"

#include <algorithm>

#include "common/world/energy.h"

namespace talus {
namespace {

constexpr double tolerated_share = 0.1;
constexpr double rest_speed = 0.5;  // [m/s]; without gravity the only scale of a world at rest

}  // namespace

template <int Dim>
EnergyLedger<Dim>::EnergyLedger(const WorldDescription<Dim>& world) : down_(world.down) {
  for (const Shape<Dim>& shape : world.shapes) {
    const double weight = shape.mass * world.gravity;
    constants_.push_back({weight, weight * shape.extent + 0.5 * shape.mass * rest_speed * rest_speed});
  }
}

template <int Dim>
void EnergyLedger<Dim>::note_added(const World<Dim>& world) {
  for (auto body = static_cast<BodyIndex>(last_.size()); body < world.states().size(); ++body)
    last_.push_back(energy(world, body, kinetic_energy(world, body)));
}

template <int Dim>
void EnergyLedger<Dim>::note_velocity(const World<Dim>& world, BodyIndex body, const Vec<Dim>& velocity,
                                      const Spin<Dim>& spin) {
  const Rotation<Dim>& rotation = world.states().pose[body].rotation;
  change_ += kinetic_energy(world, body) - kinetic_energy<Dim>(world.shape_of(body), rotation, velocity, spin);
}

template <int Dim>
void EnergyLedger<Dim>::note_state(const World<Dim>& world, BodyIndex body) {
  const double kinetic = kinetic_energy(world, body);
  const double now = energy(world, body, kinetic);
  double& last = last_[body];
  change_ += now - last;
  last = now;
  kinetic_ += kinetic;
  scale_ += constants_of(world, body).scale;
}

template <int Dim>
void EnergyLedger<Dim>::close_step() {
  rise_ = std::max(0.0, rise_ + change_);
  largest_kinetic_ = std::max(largest_kinetic_, kinetic_);
  largest_scale_ = std::max(largest_scale_, scale_);
  change_ = kinetic_ = scale_ = 0.0;
}

template <int Dim>
double EnergyLedger<Dim>::tolerance() const {
  return tolerated_share * (largest_kinetic_ + largest_scale_);
}

template <int Dim>
double EnergyLedger<Dim>::energy(const World<Dim>& world, BodyIndex body, double kinetic) const {
  const Vec<Dim>& position = world.states().pose[body].position;
  return kinetic - constants_of(world, body).weight * down_.dot(position);
}

template class EnergyLedger<2>;
template class EnergyLedger<3>;

}  // namespace talus

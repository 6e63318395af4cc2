#include "common/simulation/energy_ledger.h"

#include <algorithm>

#include "common/world/energy.h"

namespace talus {
namespace {

constexpr double tolerated_share = 0.1;
constexpr double rest_speed = 0.5;  // [m/s]; without gravity the only scale of a world at rest

}  // namespace

template <int Dim>
EnergyLedger<Dim>::EnergyLedger(const WorldDescription<Dim>& world) : shapes_(world.shapes) {
  for (const Shape<Dim>& shape : shapes_) {
    const double weight = shape.mass * world.gravity;
    constants_.push_back({weight, weight * shape.extent + 0.5 * shape.mass * rest_speed * rest_speed});
  }
}

template <int Dim>
void EnergyLedger<Dim>::note_added(const BodyStates<Dim>& states) {
  for (std::size_t i = last_.size(); i < states.shape.size(); ++i) {
    const Shape<Dim>& shape = shapes_[static_cast<std::size_t>(states.shape[i])];
    last_.push_back(energy(states, i, kinetic_energy(shape, states, i)));
  }
}

template <int Dim>
void EnergyLedger<Dim>::note_velocity(const BodyStates<Dim>& states, BodyIndex body, const Vec<Dim>& velocity,
                                      const Spin<Dim>& spin) {
  const auto i = static_cast<std::size_t>(body);
  const Shape<Dim>& shape = shapes_[static_cast<std::size_t>(states.shape[i])];
  change_ += kinetic_energy(shape, states, i) - kinetic_energy<Dim>(shape, states.pose[i].rotation, velocity, spin);
}

template <int Dim>
void EnergyLedger<Dim>::note_state(const BodyStates<Dim>& states, BodyIndex body) {
  const auto i = static_cast<std::size_t>(body);
  const auto shape = static_cast<std::size_t>(states.shape[i]);
  const double kinetic = kinetic_energy(shapes_[shape], states, i);
  const double now = energy(states, i, kinetic);
  change_ += now - last_[i];
  last_[i] = now;
  kinetic_ += kinetic;
  scale_ += constants_[shape].scale;
}

template <int Dim>
void EnergyLedger<Dim>::close_step() {
  rise_ = std::max(0.0, rise_ + change_);
  largest_kinetic_ = std::max(largest_kinetic_, kinetic_);
  last_scale_ = scale_;
  change_ = kinetic_ = scale_ = 0.0;
}

template <int Dim>
double EnergyLedger<Dim>::tolerance() const {
  return tolerated_share * (largest_kinetic_ + last_scale_);
}

template <int Dim>
double EnergyLedger<Dim>::energy(const BodyStates<Dim>& states, std::size_t i, double kinetic) const {
  return kinetic + constants_[static_cast<std::size_t>(states.shape[i])].weight * height<Dim>(states.pose[i].position);
}

template class EnergyLedger<2>;
template class EnergyLedger<3>;

}  // namespace talus

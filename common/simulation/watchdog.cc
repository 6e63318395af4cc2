#include "common/simulation/watchdog.h"

#include <algorithm>
#include <limits>

#include "common/scene/typical_body.h"
#include "common/world/energy.h"

namespace talus {
namespace {

constexpr double patience = 2.0;      // [s]: so long a due body may wait for its place without being missed
constexpr double contact_gap = 0.01;  // [m] of the engine: so far bodies that rest sink in, however thin
constexpr double near_limit = 0.999;  // share of a limit; engines compute in single precision

double at_limit(double limit) { return near_limit * near_limit * limit * limit; }

double lowest_centre(const Ground& ground, const UnitScale& units) {
  return ground.present ? ground.height - contact_gap / units.lengths() : -std::numeric_limits<double>::infinity();
}

template <int Dim>
double farthest(const Vec<Dim>& place) {
  return place.cwiseAbs().maxCoeff();
}

}  // namespace

template <int Dim>
Watchdog<Dim>::Watchdog(const Scene<Dim>& scene, const SpeedLimits& limits)
    : ledger_(scene.world),
      overlap_(typical_body(scene).extent, scene.world.gravity, scene.world.dt),
      passing_(scene.world.shapes, scene.world.obstacles),
      lowest_(lowest_centre(scene.world.ground, scene.world.units)),
      farthest_(farthest_place(scene.world.units)),
      ground_(scene.world.ground.height),
      dt_(scene.world.dt),
      speed_squared_(at_limit(limits.speed)),
      spin_squared_(at_limit(limits.spin)) {}

template <int Dim>
void Watchdog<Dim>::start_step(const World<Dim>& world) {
  ledger_.start_step(world);
  passing_.start_step(world);
}

template <int Dim>
void Watchdog<Dim>::end_step(const World<Dim>& world, std::int64_t step) {
  ledger_.end_step(world);
  for (const auto& [body, way] : passing_.end_step(world)) warnings_.note(WarningKind::passed, body, step, way);
  if (!overlap_.due(step)) return;
  for (const auto& [body, depth] : overlap_.sample(world, step))
    warnings_.note(WarningKind::overlap, body, step, depth);
}

template <int Dim>
void Watchdog<Dim>::check(const World<Dim>& world, std::span<const SleepEvent> events, std::int64_t step) {
  const BodyStates<Dim>& states = world.states();
  for (const BodyIndex body : world.awake()) {
    check_place(states, body, step);
    check_speed(states, body, step);
  }
  for (const SleepEvent& event : events) {
    if (states.asleep[event.body] == 0) continue;
    check_place(states, event.body, step);
  }
  check_energy(world, step);
}

template <int Dim>
void Watchdog<Dim>::check_place(const BodyStates<Dim>& states, BodyIndex body, std::int64_t step) {
  const Vec<Dim>& place = states.pose[body].position;
  if (height<Dim>(place) < lowest_) warnings_.note(WarningKind::below_ground, body, step, ground_ - height<Dim>(place));
  if (farthest<Dim>(place) > farthest_) warnings_.note(WarningKind::outside_world, body, step, farthest<Dim>(place));
}

template <int Dim>
void Watchdog<Dim>::check_speed(const BodyStates<Dim>& states, BodyIndex body, std::int64_t step) {
  const double speed = states.velocity[body].squaredNorm();
  const double spin = states.spin[body].squaredNorm();
  if (speed >= speed_squared_) warnings_.note(WarningKind::speed_limit, body, step, std::sqrt(speed));
  if (spin >= spin_squared_) warnings_.note(WarningKind::spin_limit, body, step, std::sqrt(spin));
}

template <int Dim>
void Watchdog<Dim>::check_energy(const World<Dim>& world, std::int64_t step) {
  if (ledger_.created() == 0.0) return;
  if (Warning* known = warnings_.find(WarningKind::energy)) {
    known->value = std::max(known->value, ledger_.created());
    return;
  }
  const auto kinetic = [&](BodyIndex body) { return kinetic_energy(world, body); };
  const auto awake = world.awake();
  const auto fastest = std::ranges::max_element(awake, {}, kinetic);
  warnings_.add({.kind = WarningKind::energy,
                 .step = step,
                 .body = fastest == awake.end() ? -1 : *fastest,
                 .bodies = static_cast<std::int64_t>(awake.size()),
                 .value = ledger_.created()});
}

/// A pour that the end of the run cuts short is late, not blocked: bodies are missed only when the last one was due
/// long ago, or when one was due long ago and none has appeared since.
template <int Dim>
void Watchdog<Dim>::finish(const Emitter<Dim>& emitter, std::int64_t step) {
  const int appeared = emitter.emitted();
  const double last_emission = static_cast<double>(step - 1) * dt_;
  const int due_long_ago = emitter.due_by(last_emission - patience);
  const bool over = due_long_ago == emitter.total();
  const bool stalled = due_long_ago > appeared && last_emission + dt_ - emitter.last_appearance() > patience;
  const int missing = emitter.due_by(last_emission) - appeared;
  if (missing <= 0 || !(over || stalled)) return;
  warnings_.add(
      {.kind = WarningKind::not_appeared, .step = step, .bodies = missing, .value = static_cast<double>(missing)});
}

template <int Dim>
int bodies_lost(const BodyStates<Dim>& states, const Ground& ground, const UnitScale& units) {
  const double lowest = lowest_centre(ground, units);
  int lost = 0;
  for (std::size_t i = 0; i < states.pose.size(); ++i) {
    const Vec<Dim>& place = states.pose[i].position;
    if (states.removed[i] != 0) continue;
    lost += height<Dim>(place) < lowest || farthest<Dim>(place) > farthest_place(units) ? 1 : 0;
  }
  return lost;
}

template class Watchdog<2>;
template class Watchdog<3>;
template int bodies_lost(const BodyStates<2>&, const Ground&, const UnitScale&);
template int bodies_lost(const BodyStates<3>&, const Ground&, const UnitScale&);

}  // namespace talus

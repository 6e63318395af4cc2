#include "common/simulation/slope_control.h"

#include <algorithm>

#include "common/math/angle.h"
#include "common/pile/angle_of_repose.h"
#include "common/scene/typical_body.h"

namespace talus {
namespace {

// Times are in sqrt(D/g), so that they hold for bodies of any size in any gravity. How the values were found:
// lab/notes/slope_control.md.
constexpr double between_measurements = 0.12;
constexpr double foreseen = 2.0;           // T
constexpr double grip_per_radian = 100.0;  // k
constexpr double max_grip = 3.0;
constexpr double allowed_steepness = in_radians(1.0);  // at most a pile without grip may be steeper than alpha

/// Whether a body at `position` may be part of the pile: within its reach, not below its base (fallen off a table), and
/// not higher than twice its height (in a hopper above it).
template <int Dim>
bool within_pile(const Pile<Dim>& pile, const Vec<Dim>& position) {
  const double above = height<Dim>(position) - height<Dim>(pile.centre);
  return pile.reaches(position) && above >= 0.0 && above < 2.0 * pile.height;
}

/// Number of the controlled pile that a body at `position` is part of; -1: none.
template <int Dim>
int controlled_pile(std::span<const Pile<Dim>> piles, const Vec<Dim>& position) {
  const int nearest = nearest_pile(piles, position);
  return nearest >= 0 && piles[nearest].slope_controlled && within_pile(piles[nearest], position) ? nearest : -1;
}

}  // namespace

template <int Dim>
SlopeControl<Dim>::SlopeControl(const Scene<Dim>& scene)
    : active_(scene.world.solver.small_steps() && std::ranges::any_of(scene.piles, &PileParams<Dim>::control_slope)),
      extent_(typical_body(scene).extent) {}

template <int Dim>
std::span<const BodyIndex> SlopeControl<Dim>::update(World<Dim>& world, const PileSet<Dim>& piles, std::int64_t step) {
  if (world.awake().empty()) return {};
  const double unit = time_unit(extent_, world);
  const auto steps = std::max<std::int64_t>(1, std::llround(between_measurements * unit / world.dt()));
  if (step % steps != 0) return {};
  controls_.resize(piles.piles().size());
  measure(world.states(), piles);
  for (std::size_t p = 0; p < controls_.size(); ++p)
    update_grip(piles.piles()[p], controls_[p], static_cast<double>(step - measured_) * world.dt() / unit);
  measured_ = step;
  const BodyStates<Dim>& states = world.states();
  for (const BodyIndex body : world.awake()) {
    const int pile = controlled_pile(piles.piles(), states.pose[body].position);
    const float grip = pile < 0 ? 0.0F : controls_[pile].grip;
    if (grip != grip_between(states, body, ground_index)) world.set_grip(body, grip);
  }
  find_held(states, piles);
  return held_;
}

template <int Dim>
void SlopeControl<Dim>::find_held(const BodyStates<Dim>& states, const PileSet<Dim>& piles) {
  held_.clear();
  if (std::ranges::none_of(controls_, &Control::too_steep)) return;
  for (BodyIndex body = 0; body < std::ssize(states.grip); ++body) {
    if (states.asleep[body] == 0 || states.grip[body] == 0.0F || states.removed[body] != 0) continue;
    const int pile = controlled_pile(piles.piles(), states.pose[body].position);
    if (pile >= 0 && controls_[pile].too_steep) held_.push_back(body);
  }
}

/// Of the bodies that have touched something, moving or not: those at rest alone are the core, up to ten degrees
/// steeper than the pile where most of it still moves.
template <int Dim>
void SlopeControl<Dim>::measure(const BodyStates<Dim>& states, const PileSet<Dim>& piles) {
  for (Control& control : controls_) control.positions.clear();
  for (BodyIndex body = 0; body < states.size(); ++body) {
    if (states.removed[body] != 0 || !piles.has_touched(body)) continue;
    const Vec<Dim>& position = states.pose[body].position;
    const int pile = controlled_pile(piles.piles(), position);
    if (pile >= 0) controls_[pile].positions.push_back(position - piles.piles()[pile].centre);
  }
}

/// A pile of too few bodies has no slope and gets the largest grip. Only sinking is foreseen: a slope that rises
/// belongs to bodies that are about to roll down.
template <int Dim>
void SlopeControl<Dim>::update_grip(const Pile<Dim>& pile, Control& control, double interval) {
  if (control.positions.size() < min_bodies_for_slope) {
    control.grip = max_grip;
    control.slope.reset();
    control.too_steep = false;
    return;
  }
  const double slope = estimate_angle_of_repose<Dim>(control.positions);
  const double sinking = control.slope ? std::max(0.0, (*control.slope - slope) / interval) : 0.0;
  control.slope = slope;
  const double missing = pile.alpha - slope + foreseen * sinking;
  control.grip = static_cast<float>(std::clamp(grip_per_radian * missing, 0.0, max_grip));
  control.too_steep = control.grip == 0.0F && slope > pile.alpha + allowed_steepness;
}

template class SlopeControl<2>;
template class SlopeControl<3>;

}  // namespace talus

#include "common/policy/adaptive/slope_controller.h"

#include <algorithm>
#include <cmath>

#include "common/pile/angle_of_repose.h"
#include "common/shape/rigid_impulse.h"

namespace talus {
namespace {

/// Time between two measurements of the slope [s]. A grid of bodies that lands as one sinks by several degrees in the
/// half second of other slow updates.
constexpr double measuring_interval = 0.1;

/// How far ahead a pile's sinking is foreseen [sqrt(D/g)]. Grids that land as one become too flat with less, too steep
/// at 35 degrees with twice as much (lab/notes/slope_control.md).
constexpr double foreseen = 2.7;

/// Whether a body at `position` may be part of the pile: within its reach, not below its base (fallen off a table), and
/// not higher than twice its height (in a hopper above it).
template <int Dim>
bool within_pile(const Pile<Dim>& pile, const Vec<Dim>& position) {
  const double above = height<Dim>(position) - height<Dim>(pile.centre);
  return pile.reaches(position) && above >= 0.0 && above < 2.0 * pile.height;
}

}  // namespace

template <int Dim>
SlopeController<Dim>::SlopeController(const RuleSetup<Dim>& setup)
    : dt_(setup.world.dt),
      steps_between_(std::max<std::int64_t>(1, std::llround(measuring_interval / setup.world.dt))),
      extent_(setup.typical.extent),
      proportional_gain_(setup.params.slope_proportional_gain),
      integral_gain_(setup.params.slope_integral_gain),
      max_damping_(setup.params.slope_max_damping) {}

/// Rates are in units of sqrt(g / D), so that the same parameters hold for bodies of any size in any gravity.
template <int Dim>
typename SlopeController<Dim>::Gains SlopeController<Dim>::gains_in(const World<Dim>& world) const {
  const double rate = std::sqrt(world.gravity_size() / extent_);
  return {.proportional = proportional_gain_ * rate,
          .integral = integral_gain_ * world.gravity_size() / extent_,
          .derivative = foreseen * time_unit(extent_, world),
          .max_damping = max_damping_ * rate};
}

template <int Dim>
void SlopeController<Dim>::update(const RuleInput<Dim>& in, RuleOutput<Dim>& out) {
  if (std::ranges::none_of(in.piles, &Pile<Dim>::slope_controlled)) return;
  find_touching(in);
  const bool due = in.step % steps_between_ == 0 || in.piles.size() != controls_.size();
  controls_.resize(in.piles.size());
  for (std::size_t p = 0; p < in.piles.size() && due; ++p)
    if (std::ranges::find(touching_, p, &Touching::pile) != touching_.end()) update_damping(in, p, gains_in(in.world));
  damp(in.states(), out);
}

template <int Dim>
void SlopeController<Dim>::find_touching(const RuleInput<Dim>& in) {
  bodies_.clear();
  for (const Contact<Dim>& contact : in.contacts) {
    bodies_.push_back(contact.a);
    if (contact.b >= 0 && !in.asleep(contact.b)) bodies_.push_back(contact.b);
  }
  std::ranges::sort(bodies_);
  bodies_.erase(std::unique(bodies_.begin(), bodies_.end()), bodies_.end());
  touching_.clear();
  for (const BodyIndex body : bodies_) {
    const Vec<Dim>& position = in.pose_of(body).position;
    const int nearest = nearest_pile(in.piles, position);
    if (nearest < 0) continue;
    const std::size_t pile = nearest;
    if (in.piles[pile].slope_controlled && within_pile(in.piles[pile], position)) touching_.push_back({body, pile});
  }
}

/// The integral part is needed because keeping a slope takes lasting damping, the derivative part since damped bodies
/// still sink. A slope that rises is that of bodies that are about to roll down: it counts as it is. Too few bodies
/// make no slope: they get the largest damping, and the integral stays as it is.
template <int Dim>
void SlopeController<Dim>::update_damping(const RuleInput<Dim>& in, std::size_t pile, const Gains& gains) {
  Control& control = controls_[pile];
  collect_positions(in, pile);
  if (positions_.size() < min_bodies_for_slope) {
    control.damping = gains.max_damping;
    control.slope.reset();
    return;
  }
  const double slope = estimate_angle_of_repose<Dim>(positions_);
  const double interval = static_cast<double>(steps_between_) * dt_;
  const double sinking = control.slope ? std::max(0.0, (*control.slope - slope) / interval) : 0.0;
  control.slope = slope;
  const double missing = in.piles[pile].alpha - slope + gains.derivative * sinking;
  control.integral = std::clamp(control.integral + gains.integral * interval * missing, 0.0, gains.max_damping);
  control.damping = std::clamp(control.integral + gains.proportional * missing, 0.0, gains.max_damping);
}

/// Of the pile's bodies, asleep or in contact. Those at rest alone are the core, up to ten degrees steeper than the
/// pile where most of it still moves (lab/notes/slope_control.md).
template <int Dim>
void SlopeController<Dim>::collect_positions(const RuleInput<Dim>& in, std::size_t pile) {
  const BodyStates<Dim>& states = in.states();
  positions_.clear();
  for (std::size_t i = 0; i < states.pose.size(); ++i) {
    const Vec<Dim>& position = states.pose[i].position;
    if (states.asleep[i] == 0 || states.removed[i] != 0 || !within_pile(in.piles[pile], position)) continue;
    if (nearest_pile(in.piles, position) == static_cast<int>(pile))
      positions_.push_back(position - in.piles[pile].centre);
  }
  for (const Touching& touching : touching_)
    if (touching.pile == pile) positions_.push_back(states.pose[touching.body].position - in.piles[pile].centre);
}

template <int Dim>
void SlopeController<Dim>::damp(const BodyStates<Dim>& states, RuleOutput<Dim>& out) const {
  for (const Touching& touching : touching_) {
    const double damping = controls_[touching.pile].damping;
    if (!(damping > 0.0)) continue;
    VelocityChange<Dim>& change = out.velocity_of(touching.body, states);
    change.velocity *= std::exp(-damping * dt_);
    change.spin *= std::exp(-damping * dt_);
  }
}

template class SlopeController<2>;
template class SlopeController<3>;

}  // namespace talus

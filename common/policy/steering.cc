#include "common/policy/steering.h"

#include <algorithm>
#include <cmath>

#include "common/pile/natural_slope.h"
#include "common/policy/impulse.h"

namespace talus {
namespace {

constexpr double seconds_between_looks = 0.5;
constexpr std::size_t least_to_steer = 16;  // fewer make no slope
constexpr double resting_fall = 0.0075;     // [D]: who is slower than after such a free fall has found its place

/// Neither above it, as in a hopper, nor below its base, as who fell off a table.
template <int Dim>
bool lies_in(const Pile<Dim>& pile, const Vec<Dim>& position) {
  const double above = height<Dim>(position) - height<Dim>(pile.centre);
  return pile.reaches(position) && above >= 0.0 && above < 2.0 * pile.height;
}

}  // namespace

// Bodies of one shape and another size fall alike but for the time that it takes, so rates are told in sqrt(g / D).
template <int Dim>
Steering<Dim>::Steering(const AdaptiveParams& params, double extent, const WorldDescription<Dim>& world)
    : dt_(world.dt),
      resting_speed_(speed_to_rise(world.gravity, resting_fall * extent)),
      gain_(params.steering_gain * std::sqrt(world.gravity / extent)),
      growth_(params.steering_growth * world.gravity / extent),
      most_(params.steering_most * std::sqrt(world.gravity / extent)),
      steps_between_looks_(std::max<std::int64_t>(1, std::llround(seconds_between_looks / world.dt))) {}

template <int Dim>
void Steering<Dim>::update(const Frame<Dim>& frame, std::span<const Contact<Dim>> contacts,
                           std::vector<Kick<Dim>>& kicks) {
  const auto piles = frame.piles.piles();
  if (std::ranges::none_of(piles, &Pile<Dim>::held)) return;
  find_touching(frame, contacts);
  const bool look = frame.step % steps_between_looks_ == 0 || piles.size() != holds_.size();
  holds_.resize(piles.size());
  for (std::size_t p = 0; p < piles.size() && look; ++p) {
    if (std::ranges::find(touching_, p, &Touching::pile) != touching_.end()) aim(frame, p);
  }
  slow(frame.world.states(), kicks);
}

template <int Dim>
void Steering<Dim>::find_touching(const Frame<Dim>& frame, std::span<const Contact<Dim>> contacts) {
  const BodyStates<Dim>& states = frame.world.states();
  const auto piles = frame.piles.piles();
  bodies_.clear();
  for (const Contact<Dim>& contact : contacts) {
    bodies_.push_back(contact.a);
    if (contact.b >= 0 && states.asleep[static_cast<std::size_t>(contact.b)] == 0) bodies_.push_back(contact.b);
  }
  std::ranges::sort(bodies_);
  bodies_.erase(std::unique(bodies_.begin(), bodies_.end()), bodies_.end());
  touching_.clear();
  for (const BodyIndex body : bodies_) {
    const Vec<Dim>& position = states.pose[static_cast<std::size_t>(body)].position;
    const int nearest = nearest_pile(piles, position);
    if (nearest < 0) continue;
    const auto pile = static_cast<std::size_t>(nearest);
    if (piles[pile].held && lies_in(piles[pile], position)) touching_.push_back({body, pile});
  }
}

/// Control by what is missing now and by what was missing so far, since a slope that is held needs drag for ever.
template <int Dim>
void Steering<Dim>::aim(const Frame<Dim>& frame, std::size_t pile) {
  Hold& hold = holds_[pile];
  find_places(frame, pile);
  if (places_.size() < least_to_steer) {
    hold.drag = most_;
    return;
  }
  const double missing = frame.piles.piles()[pile].alpha - natural_slope<Dim>(places_);
  hold.lasting = std::clamp(hold.lasting + growth_ * seconds_between_looks * missing, 0.0, most_);
  hold.drag = std::clamp(hold.lasting + gain_ * missing, 0.0, most_);
}

/// Of the pile's bodies that have found theirs: what still comes down the flank would make it too steep or too flat.
template <int Dim>
void Steering<Dim>::find_places(const Frame<Dim>& frame, std::size_t pile) {
  const BodyStates<Dim>& states = frame.world.states();
  const auto piles = frame.piles.piles();
  places_.clear();
  for (std::size_t i = 0; i < states.pose.size(); ++i) {
    const Vec<Dim>& position = states.pose[i].position;
    if (states.asleep[i] == 0 || states.removed[i] != 0 || !lies_in(piles[pile], position)) continue;
    if (nearest_pile(piles, position) == static_cast<int>(pile)) places_.push_back(position - piles[pile].centre);
  }
  for (const Touching& touching : touching_) {
    const auto i = static_cast<std::size_t>(touching.body);
    if (touching.pile != pile || states.velocity[i].norm() >= resting_speed_) continue;
    places_.push_back(states.pose[i].position - piles[pile].centre);
  }
}

template <int Dim>
void Steering<Dim>::slow(const BodyStates<Dim>& states, std::vector<Kick<Dim>>& kicks) const {
  std::ranges::sort(kicks, {}, &Kick<Dim>::body);
  kicks.reserve(kicks.size() + touching_.size());  // so that `given` stays where it is
  const std::span<Kick<Dim>> given(kicks);
  for (const Touching& touching : touching_) {
    const auto i = static_cast<std::size_t>(touching.body);
    const double drag = holds_[touching.pile].drag;
    if (!(drag > 0.0)) continue;
    const auto found = std::ranges::lower_bound(given, touching.body, {}, &Kick<Dim>::body);
    const bool known = found != given.end() && found->body == touching.body;
    Kick<Dim>& kick = known ? *found : kicks.emplace_back(Kick<Dim>{touching.body, states.velocity[i], states.spin[i]});
    kick.velocity *= std::exp(-drag * dt_);
    kick.spin *= std::exp(-drag * dt_);
  }
}

template class Steering<2>;
template class Steering<3>;

}  // namespace talus

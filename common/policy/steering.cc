#include "common/policy/steering.h"

#include <algorithm>
#include <cmath>

#include "common/pile/natural_slope.h"
#include "common/policy/impulse.h"

namespace talus {
namespace {

constexpr double seconds_between_looks = 0.5;
constexpr std::size_t least_to_measure = 16;  // fewer make no slope

}  // namespace

// Bodies of one shape and another size fall alike but for the time that it takes, so rates are told in sqrt(g / D).
template <int Dim>
Steering<Dim>::Steering(const AdaptiveParams& params, double extent, const WorldDescription<Dim>& world)
    : dt_(world.dt),
      slow_(speed_to_rise(world.gravity, params.wake_height * extent)),
      gain_(params.steering_gain * std::sqrt(world.gravity / extent)),
      growth_(params.steering_growth * world.gravity / extent),
      most_(params.steering_most * std::sqrt(world.gravity / extent)),
      steps_between_looks_(std::max<std::int64_t>(1, std::llround(seconds_between_looks / world.dt))) {}

template <int Dim>
void Steering<Dim>::update(const Frame<Dim>& frame, std::span<const Contact<Dim>> contacts,
                           std::vector<Kick<Dim>>& kicks) {
  const auto piles = frame.piles.piles();
  if (std::ranges::none_of(piles, &Pile<Dim>::held)) return;
  const BodyStates<Dim>& states = frame.world.states();
  find_touching(states, contacts);
  std::ranges::sort(kicks, {}, &Kick<Dim>::body);
  holds_.resize(piles.size());
  for (std::size_t p = 0; p < piles.size(); ++p) {
    if (!piles[p].held) continue;
    if (frame.step % steps_between_looks_ == 0) aim(piles[p], states, holds_[p]);
    if (holds_[p].drag > 0.0) slow(piles[p], std::exp(-holds_[p].drag * dt_), states, kicks);
  }
}

template <int Dim>
void Steering<Dim>::find_touching(const BodyStates<Dim>& states, std::span<const Contact<Dim>> contacts) {
  touching_.clear();
  for (const Contact<Dim>& contact : contacts) {
    touching_.push_back(contact.a);
    if (contact.b >= 0 && states.asleep[static_cast<std::size_t>(contact.b)] == 0) touching_.push_back(contact.b);
  }
  std::ranges::sort(touching_);
  touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
}

/// Control by what is missing now and by what was missing so far, since a slope that is held needs drag for ever.
template <int Dim>
void Steering<Dim>::aim(const Pile<Dim>& pile, const BodyStates<Dim>& states, Hold& hold) {
  const double missing = pile.alpha - slope(pile, states);
  hold.lasting = std::clamp(hold.lasting + growth_ * seconds_between_looks * missing, 0.0, most_);
  hold.drag = std::clamp(hold.lasting + gain_ * missing, 0.0, most_);
}

/// That of the bodies that have found their place: what still comes down the flank would make it too steep or too flat.
template <int Dim>
double Steering<Dim>::slope(const Pile<Dim>& pile, const BodyStates<Dim>& states) {
  places_.clear();
  const auto add = [&](std::size_t i) {
    const Vec<Dim>& position = states.pose[i].position;
    if (pile.reaches(position)) places_.push_back(position - pile.centre);
  };
  for (std::size_t i = 0; i < states.pose.size(); ++i) {
    if (states.asleep[i] != 0 && states.removed[i] == 0) add(i);
  }
  for (const BodyIndex body : touching_) {
    const auto i = static_cast<std::size_t>(body);
    if (states.velocity[i].norm() < slow_) add(i);
  }
  return places_.size() < least_to_measure ? 0.0 : natural_slope<Dim>(places_);
}

template <int Dim>
void Steering<Dim>::slow(const Pile<Dim>& pile, double kept, const BodyStates<Dim>& states,
                         std::vector<Kick<Dim>>& kicks) const {
  const auto known = static_cast<std::ptrdiff_t>(kicks.size());
  for (const BodyIndex body : touching_) {
    const auto i = static_cast<std::size_t>(body);
    if (!pile.reaches(states.pose[i].position)) continue;
    const auto end = kicks.begin() + known;
    const auto found = std::ranges::lower_bound(kicks.begin(), end, body, {}, &Kick<Dim>::body);
    if (found != end && found->body == body) {
      found->velocity *= kept;
      found->spin *= kept;
    } else {
      kicks.push_back({body, kept * states.velocity[i], kept * states.spin[i]});
    }
  }
  std::ranges::sort(kicks, {}, &Kick<Dim>::body);
}

template class Steering<2>;
template class Steering<3>;

}  // namespace talus

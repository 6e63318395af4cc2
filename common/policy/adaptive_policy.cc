#include "common/policy/adaptive_policy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "common/policy/bearing.h"
#include "common/policy/paper_policy.h"

namespace talus {

template <int Dim>
AdaptivePolicy<Dim>::AdaptivePolicy(const AdaptiveParams& params, const WorldDescription<Dim>& world,
                                    const TypicalBody& typical)
    : params_(params),
      dt_(world.dt),
      ground_(world.ground.present ? world.ground.height : std::numeric_limits<double>::lowest()),
      fastest_(0.95 * fastest_speed<Dim>(world.dt)),
      fastest_spin_(1.5 / world.dt),
      rest_watch_(params.rest_distance * typical.extent, params.rest_distance_woken * typical.extent, world.shapes),
      props_(params.support_slack * typical.extent),
      heavy_blows_(params, typical, world),
      blows_(params, typical.extent, world),
      avalanches_(params, typical.extent, world.ground.height),
      steering_(params, typical.extent, world) {
  for (const Shape<Dim>& shape : world.shapes) weights_.push_back(shape.mass * world.gravity * world.dt);
}

template <int Dim>
void AdaptivePolicy<Dim>::decide(const Frame<Dim>& frame, Decision<Dim>& decision) {
  const BodyStates<Dim>& states = frame.world.states();
  if (frame.world.awake().empty() && !avalanches_.waiting()) return;
  const std::span<const Contact<Dim>> contacts = frame.world.contacts();
  rest_watch_.update(frame.step, states, frame.world.awake());
  bodies_.clear();
  heavy_blows_.update(frame.world, bodies_);
  rest_watch_.expect_to_move(bodies_);
  blows_.update(frame.world, contacts, bodies_, decision.kicks);
  wake(bodies_, SleepCause::momentum, frame, decision);
  bodies_.clear();
  props_.update(contacts, states, bodies_);
  wake(bodies_, SleepCause::lost_support, frame, decision);
  bodies_.clear();
  const bool quiet = std::ranges::none_of(contacts, [](const Contact<Dim>& contact) { return contact.b >= 0; });
  avalanches_.update(frame.world, frame.piles.piles(), quiet, bodies_);
  wake(bodies_, SleepCause::avalanche, frame, decision);
  steering_.update(frame, contacts, decision.kicks);
  limit(decision.kicks);
  choose_sleepers(frame, contacts, decision);
  avalanches_.note(states, decision.freeze, decision.thaw);
}

template <int Dim>
void AdaptivePolicy<Dim>::wake(std::span<const BodyIndex> bodies, SleepCause cause, const Frame<Dim>& frame,
                               Decision<Dim>& decision) {
  const std::size_t before = decision.thaw.size();
  for (const BodyIndex body : bodies) {
    const auto known = std::span(decision.thaw).first(before);
    if (std::ranges::binary_search(known, body, {}, &SleepEvent::body)) continue;
    const Readiness place = readiness(frame, body);
    decision.thaw.push_back({.body = body, .pile = place.pile, .layer = place.layer, .cause = cause});
  }
  std::ranges::sort(decision.thaw, {}, &SleepEvent::body);
}

template <int Dim>
void AdaptivePolicy<Dim>::limit(std::span<Kick<Dim>> kicks) const {
  for (Kick<Dim>& kick : kicks) {
    kick.velocity *= fastest_ / std::max(kick.velocity.norm(), fastest_);
    kick.spin *= fastest_spin_ / std::max(kick.spin.norm(), fastest_spin_);
  }
}

template <int Dim>
void AdaptivePolicy<Dim>::choose_sleepers(const Frame<Dim>& frame, std::span<const Contact<Dim>> contacts,
                                          Decision<Dim>& decision) {
  const BodyStates<Dim>& states = frame.world.states();
  bodies_.clear();
  for (const BodyIndex body : frame.world.awake()) {
    if (!below_ground(states, body) && rested_enough(frame, body)) bodies_.push_back(body);
  }
  keep_borne<Dim>(contacts, states, weights_, params_.awake_share, bodies_);
  for (const BodyIndex body : bodies_) {
    const Readiness place = readiness(frame, body);
    decision.freeze.push_back(
        {.body = body, .pile = place.pile, .layer = place.layer, .cause = SleepCause::rest, .score = place.score});
  }
}

/// An engine pushes a body out of the ground so slowly that it counts as at rest. Asleep it would stay there.
template <int Dim>
bool AdaptivePolicy<Dim>::below_ground(const BodyStates<Dim>& states, BodyIndex body) const {
  return height<Dim>(states.pose[static_cast<std::size_t>(body)].position) < ground_;
}

/// Whom a blow or a slide did not move where it slept had come to rest before, and need not prove it again.
template <int Dim>
bool AdaptivePolicy<Dim>::rested_enough(const Frame<Dim>& frame, BodyIndex body) const {
  const double rested = static_cast<double>(rest_watch_.steps_at_rest(frame.step, body)) * dt_;
  if (rested >= params_.rest_time_woken && rest_watch_.slept_here(body)) return true;
  if (rested < params_.rest_time_deep) return false;
  const double shortened = params_.rest_time_surface - params_.rest_time_deep;
  return rested >= params_.rest_time_surface - shortened * readiness(frame, body).score;
}

/// The score of section 3.3 for a body at rest, at most 1.
template <int Dim>
typename AdaptivePolicy<Dim>::Readiness AdaptivePolicy<Dim>::readiness(const Frame<Dim>& frame, BodyIndex body) const {
  Readiness best;
  const Vec<Dim>& position = frame.world.states().pose[static_cast<std::size_t>(body)].position;
  const auto piles = frame.piles.piles();
  for (std::size_t p = 0; p < piles.size(); ++p) {
    const int layer = frame.piles.layer_of(p, body);
    if (layer < 0) continue;
    const Layer& slice = piles[p].layers[static_cast<std::size_t>(layer)];
    const double score = std::min(1.0, sleep_score(slice.density(), piles[p].closeness(position, slice), 0.0));
    if (best.pile < 0 || score > best.score) best = {static_cast<int>(p), layer, score};
  }
  return best;
}

template class AdaptivePolicy<2>;
template class AdaptivePolicy<3>;

}  // namespace talus

#include "common/policy/adaptive/adaptive_policy.h"

#include <algorithm>
#include <limits>

#include "common/policy/paper_policy.h"
#include "common/world/gravity_units.h"

namespace talus {
namespace {

std::optional<SleepRing> ring_of(const AdaptiveParams& params, const TypicalBody& typical) {
  if (params.rings == 0) return std::nullopt;
  return SleepRing{.extent = typical.extent, .rings = params.rings, .still_speed = params.ring_still_speed};
}

/// Of the fastest point of a body in a step like the last one [m].
template <int Dim>
double way_of_step(const World<Dim>& world, BodyIndex body) {
  const BodyStates<Dim>& states = world.states();
  return world.dt() * (states.velocity[body].norm() + 0.5 * world.shape_of(body).extent * states.spin[body].norm());
}

}  // namespace

template <int Dim>
AdaptivePolicy<Dim>::AdaptivePolicy(const AdaptiveParams& params, const WorldDescription<Dim>& world,
                                    const TypicalBody& typical)
    : ring_(ring_of(params, typical)),
      rest_periods_{params.rest_period_deep, params.rest_period_surface, params.rest_period_woken},
      extent_(typical.extent),
      ground_(world.ground.present ? world.ground.height : std::numeric_limits<double>::lowest()),
      rest_({params, typical, world}),
      support_({params, typical, world}) {
  if (!ring_) rules_.emplace(RuleSetup<Dim>{params, typical, world});
}

template <int Dim>
void AdaptivePolicy<Dim>::decide(const Frame<Dim>& frame, Decision<Dim>& decision) {
  const bool may_wake = rules_ ? rules_->may_wake_any() : !frame.world.stirred().empty();
  if (frame.world.awake().empty() && !may_wake) return;
  RuleInput<Dim> in{frame.world, {}, frame.piles.piles(), frame.step};
  output_.clear();
  rest_.update(in);
  find_wakes(in);
  for (const auto& [body, wake] : output_.wakes) {
    const Placement place = placement(frame, body);
    decision.thaw.push_back({.body = body, .pile = place.pile, .layer = place.layer, .cause = wake.cause});
  }
  decision.velocities.swap(output_.velocities);
  choose_sleepers(frame, in, decision);
  rest_.expect_motion(output_.wakes);
}

template <int Dim>
void AdaptivePolicy<Dim>::find_wakes(RuleInput<Dim>& in) {
  if (rules_) {
    in.contacts = in.world.contacts();
    rules_->update(in, rest_, output_);
    return;
  }
  for (const BodyIndex body : in.world.stirred())
    output_.wakes.try_emplace(body, Wake{.cause = SleepCause::motion, .before_impact = true});
}

template <int Dim>
void AdaptivePolicy<Dim>::note(const World<Dim>& world, std::span<const SleepEvent> events) {
  if (rules_) rules_->note(world, events);
}

template <int Dim>
void AdaptivePolicy<Dim>::forget(BodyIndex body) {
  rest_.forget(body);
  if (rules_) rules_->forget(body);
}

template <int Dim>
void AdaptivePolicy<Dim>::choose_sleepers(const Frame<Dim>& frame, RuleInput<Dim>& in, Decision<Dim>& decision) {
  bodies_.clear();
  const RestTimes times = rest_times_in(in.world);
  for (const Rest& rest : rest_.references()) {
    const BodyIndex body = rest.body;
    if (below_ground(in, body) || !rested_enough(frame, rest, times)) continue;
    if (rules_ ? rules_->holds(body) : is_fast(in, body)) continue;
    if (frame.may_sleep(body)) bodies_.push_back(body);
  }
  if (bodies_.empty()) return;
  in.contacts = in.world.contacts();
  support_.keep_supported(in, bodies_);
  if (rules_) rules_->note_falling_asleep(in, bodies_);
  for (const BodyIndex body : bodies_) {
    const Placement place = placement(frame, body);
    decision.freeze.push_back(
        {.body = body, .pile = place.pile, .layer = place.layer, .cause = SleepCause::rest, .score = place.score});
  }
}

/// An engine pushes a body out of the ground so slowly that it counts as at rest. Asleep it would stay there.
template <int Dim>
bool AdaptivePolicy<Dim>::below_ground(const RuleInput<Dim>& in, BodyIndex body) const {
  return height<Dim>(in.pose_of(body).position) < ground_;
}

/// Whether it would count as moving in the ring.
template <int Dim>
bool AdaptivePolicy<Dim>::is_fast(const RuleInput<Dim>& in, BodyIndex body) const {
  const double speed =
      in.states().velocity[body].norm() + bounding_radius(in.shape_of(body)) * in.states().spin[body].norm();
  return speed > ring_->still_speed * speed_unit(ring_->extent, in.world.gravity_size());
}

/// [s]
template <int Dim>
typename AdaptivePolicy<Dim>::RestTimes AdaptivePolicy<Dim>::rest_times_in(const World<Dim>& world) const {
  const double unit = time_unit(extent_, world);
  return {rest_periods_.deep * unit, rest_periods_.surface * unit, rest_periods_.woken * unit};
}

/// The short time holds for a body that woke and did not move: it was found at rest before.
template <int Dim>
bool AdaptivePolicy<Dim>::rested_enough(const Frame<Dim>& frame, const Rest& rest, const RestTimes& times) const {
  const double rested = rest_.time() - rest.since;
  if (rested >= times.woken && rest.unmoved_since_wake) return true;
  return rested >= times.deep && rested >= rest_time_needed(frame, rest.body, times);
}

/// A body that is about to leave the place of its rest is not near its sleep.
template <int Dim>
void AdaptivePolicy<Dim>::note_near_sleep(const World<Dim>& world, std::vector<std::uint8_t>& near) const {
  constexpr double longest_next = 1.25;  // step over the last one
  constexpr double farthest = 2.0;       // way of the next step over the distance that counts as rest
  const RestTimes times = rest_times_in(world);
  const double then = rest_.time() + longest_next * world.dt();
  for (const Rest& rest : rest_.references()) {
    const double needed = rest.unmoved_since_wake ? std::min(times.woken, times.deep) : times.deep;
    near[rest.body] = then - rest.since >= needed && way_of_step(world, rest.body) <= farthest * rest_.distance();
  }
}

/// Of a body that moved since it woke [s].
template <int Dim>
double AdaptivePolicy<Dim>::rest_time_needed(const Frame<Dim>& frame, BodyIndex body, const RestTimes& times) const {
  const double shortened = times.surface - times.deep;
  return times.surface - shortened * placement(frame, body).score;
}

template <int Dim>
std::vector<Reading> AdaptivePolicy<Dim>::readings(const Frame<Dim>& frame, BodyIndex body) const {
  std::vector<Reading> readings;
  if (frame.world.states().asleep[body] != 0) {
    const std::optional<double> creep = rules_ ? rules_->checks().expected_motion(body) : std::nullopt;
    if (creep)
      readings.push_back({"creep measured by the last check", *creep, rules_->checks().tolerance(), "m",
                          "the check would have gone on"});
    return readings;
  }
  if (rules_ && rules_->holds(body)) readings.push_back({"held awake by a stability check", 1.0, std::nullopt, "", ""});
  if (!rest_.watches(body)) return readings;
  const bool unmoved = rest_.unmoved_since_wake(body);
  const RestTimes times = rest_times_in(frame.world);
  const double moved_needs = rest_time_needed(frame, body, times);
  const double needed = unmoved ? std::min(times.woken, moved_needs) : moved_needs;
  readings.push_back({"at rest for", rest_.time_at_rest(body), needed, "s", "sleeps, if supported"});
  return readings;
}

/// With the score of section 3.3 for a body at rest, at most 1.
template <int Dim>
typename AdaptivePolicy<Dim>::Placement AdaptivePolicy<Dim>::placement(const Frame<Dim>& frame, BodyIndex body) const {
  Placement best;
  const Vec<Dim>& position = frame.world.states().pose[body].position;
  const auto piles = frame.piles.piles();
  for (std::size_t p = 0; p < piles.size(); ++p) {
    const int layer = frame.piles.layer_of(p, body);
    if (layer < 0) continue;
    const Layer& slice = piles[p].layers[layer];
    const double score = std::min(1.0, sleep_score(slice.density(), piles[p].closeness(position, slice), 0.0));
    if (best.pile < 0 || score > best.score) best = {static_cast<int>(p), layer, score};
  }
  return best;
}

template class AdaptivePolicy<2>;
template class AdaptivePolicy<3>;

}  // namespace talus

#include "common/policy/blows.h"

#include <algorithm>
#include <tuple>

#include "common/policy/impulse.h"

namespace talus {
namespace {

template <typename Push>
bool push_before(const Push& l, const Push& r) {
  return std::tie(l.awake, l.sleeper) < std::tie(r.awake, r.sleeper);
}

/// How much of a blow counts whose impulse on the striker points this way: of one from straight above, which what bears
/// the sleeper takes up, a third; from the side all; from below, where nothing is in the way, five thirds.
template <int Dim>
double give_way(const Vec<Dim>& along) {
  return 1.0 - 2.0 / 3.0 * height<Dim>(along);
}

}  // namespace

template <int Dim>
Blows<Dim>::Blows(const AdaptiveParams& params, double extent, const WorldDescription<Dim>& world)
    : wake_speed_(speed_to_rise(world.gravity, params.wake_height * extent)), shapes_(world.shapes) {}

template <int Dim>
void Blows<Dim>::update(const World<Dim>& world, std::span<const Contact<Dim>> contacts, std::vector<BodyIndex>& hit,
                        std::vector<Kick<Dim>>& kicks) {
  const BodyStates<Dim>& states = world.states();
  gather(states, contacts);
  for (const Push& push : pushes_) {
    const Blow felt = blow(states, push);
    if (!(felt.speed > wake_speed_)) continue;
    hit.push_back(push.sleeper);
    kick(states, push.awake, push.place, (felt.share - 1.0) * felt.impulse, kicks);
    kick(states, push.sleeper, push.place, -felt.share * felt.impulse, kicks);
  }
  std::sort(hit.begin(), hit.end());
  hit.erase(std::unique(hit.begin(), hit.end()), hit.end());
  last_awake_.assign(world.awake().begin(), world.awake().end());
}

template <int Dim>
void Blows<Dim>::gather(const BodyStates<Dim>& states, std::span<const Contact<Dim>> contacts) {
  last_pushes_.swap(pushes_);
  pushes_.clear();
  fastest_approach_ = 0.0;
  for (const Contact<Dim>& contact : contacts) {
    fastest_approach_ = std::max(fastest_approach_, contact.approach_speed);
    if (contact.b < 0 || states.asleep[static_cast<std::size_t>(contact.b)] == 0) continue;
    if (pushes_.empty() || pushes_.back().awake != contact.a || pushes_.back().sleeper != contact.b) {
      pushes_.push_back({.awake = contact.a, .sleeper = contact.b});
    }
    Push& push = pushes_.back();
    push.impulse += contact.normal_impulse * contact.normal + contact.friction_impulse;
    push.weight += contact.normal_impulse;
    if (push.weight > 0.0) push.place += contact.normal_impulse / push.weight * (contact.point - push.place);
    push.approach = std::max(push.approach, contact.approach_speed);
  }
}

/// Two free bodies meet without bouncing: the impulse shrinks as what gives way to it grows. Deep overlaps make engines
/// push harder than the motion explains, so nobody leaves a blow faster than the fastest approach of the step.
template <int Dim>
typename Blows<Dim>::Blow Blows<Dim>::blow(const BodyStates<Dim>& states, const Push& push) const {
  const double size = push.impulse.norm();
  if (!(size > 0.0)) return {};
  const Vec<Dim> along = push.impulse / size;
  const auto yields = [&](BodyIndex body) {
    return yielding<Dim>(shape_of(states, body), states.pose[static_cast<std::size_t>(body)], push.place, along);
  };
  const double awake_yields = yields(push.awake);
  const double sleeper_yields = yields(push.sleeper);
  Blow blow;
  blow.share = awake_yields / (awake_yields + sleeper_yields);
  const double most = fastest_approach_ / (blow.share * sleeper_yields);
  blow.impulse = std::clamp(growth(push, along, awake_yields), 0.0, std::min(size, most)) * along;
  blow.speed = give_way<Dim>(along) * blow.share * blow.impulse.norm() * sleeper_yields;
  return blow;
}

/// What came on top of the load of the step before [N s]. A body that woke just now carries a load of which nothing is
/// known, but its approach explains no more of a blow than this.
template <int Dim>
double Blows<Dim>::growth(const Push& push, const Vec<Dim>& along, double awake_yields) const {
  const auto last = std::lower_bound(last_pushes_.begin(), last_pushes_.end(), push, push_before<Push>);
  if (last != last_pushes_.end() && !push_before(push, *last)) return (push.impulse - last->impulse).dot(along);
  if (std::binary_search(last_awake_.begin(), last_awake_.end(), push.awake)) return push.impulse.norm();
  return push.approach / awake_yields;
}

template <int Dim>
void Blows<Dim>::kick(const BodyStates<Dim>& states, BodyIndex body, const Vec<Dim>& place, const Vec<Dim>& impulse,
                      std::vector<Kick<Dim>>& kicks) const {
  const auto i = static_cast<std::size_t>(body);
  auto found = std::find_if(kicks.begin(), kicks.end(), [body](const Kick<Dim>& kick) { return kick.body == body; });
  if (found == kicks.end()) found = kicks.insert(kicks.end(), {body, states.velocity[i], states.spin[i]});
  push<Dim>(shape_of(states, body), states.pose[i], place, impulse, found->velocity, found->spin);
}

template class Blows<2>;
template class Blows<3>;

}  // namespace talus

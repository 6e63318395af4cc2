#include "common/policy/props.h"

#include <algorithm>
#include <tuple>

namespace talus {
namespace {

/// Of a contact's normal, from a sleeper to an awake body: above, the awake one lies on top and bears nothing.
constexpr double on_top = 0.3;

template <typename Prop>
bool prop_before(const Prop& l, const Prop& r) {
  return std::tie(l.bearer, l.borne) < std::tie(r.bearer, r.borne);
}

}  // namespace

template <int Dim>
void Props<Dim>::update(std::span<const Contact<Dim>> contacts, const BodyStates<Dim>& states,
                        std::vector<BodyIndex>& left) {
  forget_settled(states);
  remember(contacts, states);
  for (const Prop& prop : props_) {
    const Vec<Dim> now = states.pose[static_cast<std::size_t>(prop.bearer)] * prop.local;
    if ((now - prop.place).norm() > slack_) left.push_back(prop.borne);
  }
  std::sort(left.begin(), left.end());
  left.erase(std::unique(left.begin(), left.end()), left.end());
}

/// A prop ends when its bearer sleeps again or what it bears wakes.
template <int Dim>
void Props<Dim>::forget_settled(const BodyStates<Dim>& states) {
  std::erase_if(props_, [&](const Prop& prop) {
    const auto bearer = static_cast<std::size_t>(prop.bearer);
    const auto borne = static_cast<std::size_t>(prop.borne);
    return states.asleep[bearer] != 0 || states.asleep[borne] == 0 || states.removed[bearer] != 0;
  });
}

template <int Dim>
void Props<Dim>::remember(std::span<const Contact<Dim>> contacts, const BodyStates<Dim>& states) {
  fresh_.clear();
  for (const Contact<Dim>& contact : contacts) {
    if (contact.b < 0 || states.asleep[static_cast<std::size_t>(contact.b)] == 0) continue;
    if (states.asleep[static_cast<std::size_t>(contact.a)] != 0 || height<Dim>(contact.normal) > on_top) continue;
    const Prop prop{.bearer = contact.a, .borne = contact.b};
    if (!fresh_.empty() && !prop_before(fresh_.back(), prop)) continue;  // further points of one pair
    if (std::binary_search(props_.begin(), props_.end(), prop, prop_before<Prop>)) continue;
    const Pose<Dim>& pose = states.pose[static_cast<std::size_t>(contact.a)];
    const Vec<Dim> local = pose.rotation.inverse() * (contact.point - pose.position);
    fresh_.push_back({contact.a, contact.b, contact.point, local});
  }
  const auto old = static_cast<std::ptrdiff_t>(props_.size());
  props_.insert(props_.end(), fresh_.begin(), fresh_.end());
  std::inplace_merge(props_.begin(), props_.begin() + old, props_.end(), prop_before<Prop>);
}

template class Props<2>;
template class Props<3>;

}  // namespace talus

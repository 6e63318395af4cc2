#include "tools/serve/contact_memory.h"

#include <algorithm>

namespace talus {
namespace {

/// Whether a side of a contact does not move: a sleeping body, ground or obstacle.
template <int Dim>
bool rests(const BodyStates<Dim>& states, BodyIndex side) {
  return side < 0 || (states.asleep[side] != 0 && states.removed[side] == 0);
}

template <int Dim>
bool removed(const BodyStates<Dim>& states, const Contact<Dim>& contact) {
  return states.removed[contact.a] != 0 || (contact.b >= 0 && states.removed[contact.b] != 0);
}

}  // namespace

template <int Dim>
void ContactMemory<Dim>::want(bool wanted, const World<Dim>& world) {
  if (wanted == wanted_) return;
  wanted_ = wanted;
  kept_.clear();
  last_.clear();
  if (wanted) last_.assign(world.contacts().begin(), world.contacts().end());
}

/// A body with an event in this step was awake in it, or is from now on: what was kept of it no longer holds.
template <int Dim>
void ContactMemory<Dim>::on_frame(const Frame<Dim>& frame) {
  if (!wanted_) return;
  const BodyStates<Dim>& states = frame.world.states();
  moved_.assign(states.asleep.size(), 0);
  for (const SleepEvent& event : frame.events) moved_[event.body] = 1;
  kept_.insert(kept_.end(), last_.begin(), last_.end());
  std::erase_if(kept_, [&](const Contact<Dim>& contact) {
    const auto holds = [&](BodyIndex side) { return side < 0 || (rests(states, side) && moved_[side] == 0); };
    return !holds(contact.a) || !holds(contact.b);
  });
  last_.assign(frame.world.contacts().begin(), frame.world.contacts().end());
}

template <int Dim>
std::vector<ShownContact<Dim>> ContactMemory<Dim>::contacts(const World<Dim>& world) const {
  const BodyStates<Dim>& states = world.states();
  std::vector<ShownContact<Dim>> shown;
  const auto show = [&](const Contact<Dim>& contact) {
    if (contact.normal_impulse <= 0.0 || removed(states, contact)) return;  // near, but without force
    shown.push_back({.a = contact.a,
                     .b = contact.b,
                     .point = contact.point,
                     .normal_force = contact.normal_impulse / dt_ * contact.normal,
                     .friction_force = contact.friction_impulse / dt_,
                     .kept = rests(states, contact.a) && rests(states, contact.b)});
  };
  for (const Contact<Dim>& contact : kept_) show(contact);
  for (const Contact<Dim>& contact : last_) show(contact);
  return shown;
}

template class ContactMemory<2>;
template class ContactMemory<3>;

}  // namespace talus

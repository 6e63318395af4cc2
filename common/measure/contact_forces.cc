#include "common/measure/contact_forces.h"

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

/// Each point once: of two bodies under the one with the lower index.
template <int Dim>
std::vector<Contact<Dim>> kept_by_ring(const World<Dim>& world) {
  std::vector<Contact<Dim>> found;
  world.sleeping_contacts(ground_index, found);
  for (BodyIndex k = 0; k < std::ssize(world.obstacles()); ++k) world.sleeping_contacts(first_obstacle - k, found);
  for (BodyIndex body = 0; body < world.states().size(); ++body) world.sleeping_contacts(body, found);
  std::erase_if(found, [](const Contact<Dim>& contact) { return contact.b >= 0 && contact.b < contact.a; });
  return found;
}

}  // namespace

template <int Dim>
void ContactForces<Dim>::record(bool on, const World<Dim>& world) {
  if (on == on_) return;
  on_ = on;
  kept_.clear();
  last_.clear();
  if (on) last_.assign(world.contacts().begin(), world.contacts().end());
}

/// A body with an event in this step was awake in it, or is from now on: what was kept of it no longer holds.
template <int Dim>
void ContactForces<Dim>::on_frame(const Frame<Dim>& frame) {
  if (!on_) return;
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
std::vector<ContactForce<Dim>> ContactForces<Dim>::of(const World<Dim>& world) const {
  const BodyStates<Dim>& states = world.states();
  std::vector<ContactForce<Dim>> forces;
  if (!on_) return forces;
  const auto add = [&](const Contact<Dim>& contact) {
    if (contact.normal_impulse == 0.0 || removed(states, contact)) return;  // near, but without force
    forces.push_back({.a = contact.a,
                      .b = contact.b,
                      .point = contact.point,
                      .normal_force = contact.normal_impulse / world.dt() * contact.normal,
                      .friction_force = contact.friction_impulse / world.dt(),
                      .kept = rests(states, contact.a) && rests(states, contact.b)});
  };
  for (const Contact<Dim>& contact : world.has_ring() ? kept_by_ring(world) : kept_) add(contact);
  for (const Contact<Dim>& contact : last_)
    if (!world.has_ring() || !rests(states, contact.a) || !rests(states, contact.b)) add(contact);
  return forces;
}

template class ContactForces<2>;
template class ContactForces<3>;

}  // namespace talus

#include "common/sleeper/given_world.h"

#include <algorithm>
#include <utility>

namespace talus {
namespace {

/// Boxes are larger than the bodies by this part of their extent, as those of engines are: bodies that touch with a
/// small gap have boxes that touch.
constexpr double box_margin = 0.02;

template <int Dim>
WorldDescription<Dim> empty_description(const Vec<Dim>& gravity) {
  WorldDescription<Dim> description;
  description.ground.present = false;
  description.set_gravity(gravity);
  return description;
}

template <int Dim>
Contact<Dim> turned_over(Contact<Dim> contact) {
  std::swap(contact.a, contact.b);
  contact.normal *= -1.0;
  contact.friction_impulse *= -1.0;
  return contact;
}

}  // namespace

template <int Dim>
GivenWorld<Dim>::GivenWorld(const Vec<Dim>& gravity) : World<Dim>(empty_description<Dim>(gravity)) {
  this->record_contacts(true);
}

template <int Dim>
std::optional<BodyIndex> GivenWorld<Dim>::free_number() const {
  if (free_.empty()) return std::nullopt;
  return free_.back();
}

template <int Dim>
int GivenWorld<Dim>::number_of(const Shape<Dim>& shape) {
  const auto taken = shapes_.take(shape);
  if (taken.is_new) this->put_shape(taken.number, shape);
  return taken.number;
}

template <int Dim>
void GivenWorld<Dim>::reshape(BodyIndex body, const Shape<Dim>& shape) {
  const int before = this->states().shape[body];
  this->writable_states().shape[body] = number_of(shape);
  shapes_.release(before);
}

template <int Dim>
BodyIndex GivenWorld<Dim>::put(const Shape<Dim>& shape, const Pose<Dim>& pose) {
  const BodyIndex body = this->add_unchecked(number_of(shape), pose, free_number());
  if (!free_.empty()) free_.pop_back();
  columns_.put(body, pose.position, shape.extent);
  return body;
}

template <int Dim>
void GivenWorld<Dim>::sort_for(double extent) {
  columns_ = BodyColumns<Dim>(2.0 * extent);
  for (BodyIndex body = 0; body < this->states().size(); ++body)
    if (this->states().removed[body] == 0)
      columns_.put(body, this->states().pose[body].position, this->shape_of(body).extent);
}

template <int Dim>
void GivenWorld<Dim>::engine_remove(std::span<const BodyIndex> bodies) {
  for (const BodyIndex body : bodies) {
    columns_.take_out(body);
    shapes_.release(this->states().shape[body]);
    free_.push_back(body);
  }
}

template <int Dim>
int GivenWorld<Dim>::add_obstacle(const Shape<Dim>& shape, const Pose<Dim>& pose, bool moves) {
  int number = static_cast<int>(this->obstacles().size());
  if (!free_obstacles_.empty()) {
    number = free_obstacles_.back();
    free_obstacles_.pop_back();
  }
  this->put_obstacle(number, {shape, pose, moves});
  return number;
}

template <int Dim>
void GivenWorld<Dim>::give(BodyIndex body, const Pose<Dim>& pose, const Vec<Dim>& velocity, const Spin<Dim>& spin) {
  BodyStates<Dim>& states = this->writable_states();
  states.velocity[body] = velocity;
  states.spin[body] = spin;
  place(body, pose);
}

template <int Dim>
void GivenWorld<Dim>::place(BodyIndex body, const Pose<Dim>& pose) {
  this->writable_states().pose[body] = pose;
  columns_.put(body, pose.position, this->shape_of(body).extent);
}

/// Brings the contacts into the form of World::contacts(): those of awake bodies, of two the one with the lower number
/// first, pairs side by side.
template <int Dim>
void GivenWorld<Dim>::give_contacts(std::span<const Contact<Dim>> contacts) {
  const auto turns = [this](BodyIndex a, BodyIndex b) { return listed_under_second(a, b, this->states().asleep); };
  runs_.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto [a, b] = turns(contacts[i].a, contacts[i].b) ? std::pair(contacts[i].b, contacts[i].a)
                                                            : std::pair(contacts[i].a, contacts[i].b);
    if (!is_awake(a)) continue;
    const std::int64_t pair = pair_order(a, b);
    if (!runs_.empty() && runs_.back().pair == pair && runs_.back().first + runs_.back().count == i)
      ++runs_.back().count;
    else
      runs_.push_back({pair, i, 1});
  }
  std::ranges::sort(runs_, {}, [](const Run& run) { return std::pair(run.pair, run.first); });
  given_.clear();
  for (const Run& run : runs_)
    for (const Contact<Dim>& contact : contacts.subspan(run.first, run.count))
      given_.push_back(turns(contact.a, contact.b) ? turned_over(contact) : contact);
}

template <int Dim>
void GivenWorld<Dim>::engine_contacts(std::vector<Contact<Dim>>& contacts) const {
  contacts.insert(contacts.end(), given_.begin(), given_.end());
}

template <int Dim>
void GivenWorld<Dim>::engine_query_box(const Box<Dim>& box, std::vector<BodyIndex>& found) const {
  const auto before = static_cast<std::ptrdiff_t>(found.size());
  columns_.query(box, found);
  const auto larger = [](const Box<Dim>& inner, double margin) {
    return Box<Dim>(inner.min().array() - margin, inner.max().array() + margin);
  };
  const auto apart = [&](BodyIndex body) {
    const Shape<Dim>& shape = this->shape_of(body);
    const double margin = box_margin * shape.extent;
    const double reach = shape.bounds.min().cwiseAbs().cwiseMax(shape.bounds.max().cwiseAbs()).norm();
    // Most bodies of a column lie far above or below the box: they are left out before their shape is turned.
    return !larger(box, reach + margin).contains(this->states().pose[body].position) ||
           !box.intersects(larger(this->bounds_of(body), margin));
  };
  found.erase(std::remove_if(found.begin() + before, found.end(), apart), found.end());
}

template class GivenWorld<2>;
template class GivenWorld<3>;

}  // namespace talus

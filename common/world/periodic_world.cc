#include "common/world/periodic_world.h"

#include <algorithm>

namespace talus {
namespace {

/// So far beyond a side, in periods, a body stays: one that rests at a side must not go to and fro.
constexpr double at_side = 1e-3;
/// An image is put back once it is farther from its place than single precision explains, in periods.
constexpr double off_place = 1e-6;

/// Each body is several of the inner world's: itself and an image behind each upper side (in a corner of two axes,
/// three images). A pair that touches through a side is then a body and an image, or two images each behind one side;
/// the solver has one body for all. Obstacles have images behind all sides, since images of bodies do not meet them.
template <int Dim>
class PeriodicWorld final : public World<Dim> {
 public:
  PeriodicWorld(const WorldDescription<Dim>& description, std::unique_ptr<World<Dim>> inner)
      : World<Dim>(description, inner->speed_limits()),
        inner_(std::move(inner)),
        shifts_(this->periodic().shifts(0)),
        obstacle_shifts_(this->periodic().shifts(-1)) {
    for (const Shape<Dim>& shape : description.shapes) reach_ = std::max(reach_, bounding_radius(shape));
  }

 private:
  int images() const { return static_cast<int>(shifts_.size()); }
  BodyIndex inner(BodyIndex body, int image = 0) const { return body * images() + image; }
  Pose<Dim> image_of(const Pose<Dim>& pose, int image) const { return {pose.position + shifts_[image], pose.rotation}; }

  Pose<Dim> engine_add(BodyIndex body, const BodyDef<Dim>& def) override {
    const Pose<Dim> pose{this->periodic().inside(def.pose.position), def.pose.rotation};
    for (int image = 0; image < images(); ++image)
      inner_->add({def.shape, image_of(pose, image), def.velocity, def.spin, Image{inner(body), image}});
    return inner_->states().pose[inner(body)];
  }
  void engine_remove(std::span<const BodyIndex> bodies) override { inner_->remove(with_images(bodies)); }

  EngineTimes engine_step() override {
    inner_->record_contacts(this->records_contacts());
    for (const Push<Dim>& push : this->pushes()) inner_->push(inner(push.body), push.force);
    for (std::size_t k = 0; k < this->belts().size(); ++k)
      if (this->has_obstacle(static_cast<int>(k)) && this->obstacles()[k].moves)
        for_each_image(static_cast<int>(k),
                       [&](int number, const Vec<Dim>&) { inner_->set_surface_velocity(number, this->belts()[k]); });
    try {
      inner_->step();
    } catch (const NonFiniteState& failure) {
      throw NonFiniteState(failure.step, failure.body / images());
    }
    for (const BodyIndex body : this->awake()) keep_between_sides(body);
    stirred_.clear();
    for (const BodyIndex body : inner_->stirred()) stirred_.push_back(body / images());
    return inner_->times();
  }

  void keep_between_sides(BodyIndex body) {
    const Pose<Dim> pose = inner_->states().pose[inner(body)];
    const Vec<Dim> place = this->periodic().inside(pose.position, at_side);
    if (place != pose.position) inner_->place(inner(body), {place, pose.rotation});
    put_images(body, off_place * this->periodic().period.maxCoeff());
  }

  /// That are farther than `apart` from where they belong [m].
  void put_images(BodyIndex body, double apart) {
    for (int image = 1; image < images(); ++image) {
      const Pose<Dim> at = image_of(inner_->states().pose[inner(body)], image);
      const Vec<Dim> off = at.position - inner_->states().pose[inner(body, image)].position;
      if (off.cwiseAbs().maxCoeff() > apart) inner_->place(inner(body, image), at);
    }
  }

  std::optional<BodyIndex> engine_read(BodyStates<Dim>& states) override {
    for (const BodyIndex body : this->awake()) read(body, states);
    return std::nullopt;  // the inner world has thrown
  }
  void read(BodyIndex body, BodyStates<Dim>& states) const {
    const BodyStates<Dim>& from = inner_->states();
    states.pose[body] = from.pose[inner(body)];
    states.velocity[body] = from.velocity[inner(body)];
    states.spin[body] = from.spin[inner(body)];
  }

  void engine_set_velocity(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin) override {
    for (int image = 0; image < images(); ++image) inner_->set_velocity(inner(body, image), velocity, spin);
  }

  void engine_set_grip(BodyIndex body, double grip) override {
    for (int image = 0; image < images(); ++image) inner_->set_grip(inner(body, image), grip);
  }

  /// Calls do_it(number in the inner world, how far it is from the obstacle).
  template <typename Do>
  void for_each_image(int obstacle, Do do_it) const {
    for (std::size_t image = 0; image < obstacle_shifts_.size(); ++image)
      do_it(obstacle + static_cast<int>(image * this->obstacles().size()), obstacle_shifts_[image]);
  }
  void engine_move_obstacle(int number, const Pose<Dim>& to, const Vec<Dim>& /*velocity*/,
                            const Spin<Dim>& /*spin*/) override {
    for_each_image(number, [&](int image, const Vec<Dim>& shift) {
      inner_->move_obstacle(image, {to.position + shift, to.rotation});
    });
  }
  void engine_remove_obstacle(int number) override {
    for_each_image(number, [&](int image, const Vec<Dim>&) { inner_->remove_obstacle(image); });
  }
  void engine_restore_obstacle(int number) override {
    const Pose<Dim>& at = this->obstacle_pose(number);
    for_each_image(number, [&](int image, const Vec<Dim>& shift) {
      inner_->restore_obstacle(image, {at.position + shift, at.rotation});
    });
  }
  void engine_set_gravity(const Vec<Dim>& gravity) override { inner_->set_gravity(gravity); }

  void engine_freeze(std::span<const BodyIndex> bodies) override { inner_->freeze(with_images(bodies)); }
  void engine_thaw(std::span<const BodyIndex> bodies) override {
    inner_->thaw(with_images(bodies));
    for (const BodyIndex body : bodies) {
      read(body, this->writable_states());
      put_images(body, 0.0);
      engine_set_velocity(body, this->states().velocity[body], this->states().spin[body]);
    }
  }
  std::span<const BodyIndex> with_images(std::span<const BodyIndex> bodies) {
    all_.clear();
    for (const BodyIndex body : bodies)
      for (int image = 0; image < images(); ++image) all_.push_back(inner(body, image));
    return all_;
  }

  void engine_set_ring(const std::optional<SleepRing>& ring) override { inner_->set_ring(ring); }
  std::span<const BodyIndex> engine_stirred() const override { return stirred_; }
  bool engine_feels(BodyIndex body, BodyIndex side) const override {
    if (side > first_obstacle) return inner_->feels(inner(body), side < 0 ? side : inner(side));
    bool feels = false;
    for_each_image(first_obstacle - side, [&](int number, const Vec<Dim>&) {
      feels = feels || inner_->feels(inner(body), first_obstacle - number);
    });
    return feels;
  }
  void engine_sleeping_contacts(BodyIndex side, std::vector<Contact<Dim>>& found) const override {
    const std::size_t before = found.size();
    if (side > first_obstacle)
      inner_->sleeping_contacts(side < 0 ? side : inner(side), found);
    else
      for_each_image(first_obstacle - side,
                     [&](int number, const Vec<Dim>&) { inner_->sleeping_contacts(first_obstacle - number, found); });
    for (Contact<Dim>& contact : std::span(found).subspan(before)) contact = outward(contact);
  }
  int engine_solved_sleepers() const override { return inner_->solved_sleepers(); }
  void engine_share_among(const std::shared_ptr<Team>& team) override { inner_->share_among(team); }

  /// Images are behind the upper sides: what reaches below a lower side, or where a body may that lies inside of the
  /// upper one, is searched for behind the upper one.
  void engine_query_box(const Box<Dim>& box, std::vector<BodyIndex>& found) const override {
    const Periodic<Dim>& sides = this->periodic();
    const auto before = static_cast<std::ptrdiff_t>(found.size());
    for (const Vec<Dim>& shift : shifts_) {
      const auto reaches_below = [&](int axis) {
        return box.min()[axis] < sides.low[axis] + at_side * sides.period[axis] + reach_;
      };
      bool needed = true;
      for (int axis = 0; axis < Dim; ++axis) needed = needed && (shift[axis] == 0.0 || reaches_below(axis));
      if (needed) inner_->query_box({box.min() + shift, box.max() + shift}, found);
    }
    for (auto each = found.begin() + before; each != found.end(); ++each) *each /= images();
  }

  void engine_contacts(std::vector<Contact<Dim>>& contacts) const override {
    const auto before = static_cast<std::ptrdiff_t>(contacts.size());
    for (const Contact<Dim>& contact : inner_->contacts()) contacts.push_back(outward(contact));
    std::stable_sort(contacts.begin() + before, contacts.end(), [](const Contact<Dim>& one, const Contact<Dim>& other) {
      return std::pair(one.a, one.b) < std::pair(other.a, other.b);
    });
  }
  Contact<Dim> outward(Contact<Dim> contact) const {
    contact.a /= images();
    if (contact.b >= 0) contact.b /= images();
    if (contact.b <= first_obstacle)
      contact.b = first_obstacle - (first_obstacle - contact.b) % static_cast<int>(this->obstacles().size());
    contact.point = this->periodic().near(contact.point, this->states().pose[contact.a].position);
    return contact;
  }
  bool engine_awake(BodyIndex body) const override { return inner_->states().asleep[inner(body)] == 0; }

  std::unique_ptr<World<Dim>> inner_;
  double reach_ = 0.0;                     // of any body, from its centre [m]
  std::vector<Vec<Dim>> shifts_;           // to the images of a body
  std::vector<Vec<Dim>> obstacle_shifts_;  // to those of an obstacle
  std::vector<BodyIndex> stirred_;         // see World::stirred()
  std::vector<BodyIndex> all_;             // scratch
};

}  // namespace

template <int Dim>
std::unique_ptr<World<Dim>> make_with_sides(const WorldDescription<Dim>& description, const WorldMaker<Dim>& make) {
  if (!description.periodic().any()) return make(description);
  check(description);
  WorldDescription<Dim> inner = description;
  inner.periodic_x.reset();
  inner.periodic_y.reset();
  inner.obstacles.clear();
  for (const Vec<Dim>& shift : description.periodic().shifts(-1))
    for (Obstacle<Dim> obstacle : description.obstacles) {
      obstacle.pose.position += shift;
      inner.obstacles.push_back(std::move(obstacle));
    }
  return std::make_unique<PeriodicWorld<Dim>>(description, make(inner));
}

template std::unique_ptr<World<2>> make_with_sides(const WorldDescription<2>&, const WorldMaker<2>&);
template std::unique_ptr<World<3>> make_with_sides(const WorldDescription<3>&, const WorldMaker<3>&);

}  // namespace talus

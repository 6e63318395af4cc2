#include "common/world/scaled_world.h"

#include <algorithm>
#include <limits>

#include "common/world/periodic_world.h"

namespace talus {
namespace {

/// Hands each call on to a world in the units of the engine.
template <int Dim>
class ScaledWorld final : public World<Dim> {
 public:
  ScaledWorld(const WorldDescription<Dim>& description, std::unique_ptr<World<Dim>> inner)
      : World<Dim>(description, {inner->speed_limits().speed / description.units.speeds(),
                                 inner->speed_limits().spin * description.units.times()}),
        inner_(std::move(inner)),
        lengths_(description.units.lengths()),
        times_(description.units.times()) {}

 private:
  Pose<Dim> inward(const Pose<Dim>& pose) const { return {lengths_ * pose.position, pose.rotation}; }
  Pose<Dim> outward(const Pose<Dim>& pose) const { return {pose.position / lengths_, pose.rotation}; }

  Pose<Dim> engine_add(BodyIndex body, const BodyDef<Dim>& def) override {
    inner_->add({def.shape, inward(def.pose), times_ * def.velocity, def.spin / times_});
    return outward(inner_->states().pose[body]);
  }
  void engine_remove(std::span<const BodyIndex> bodies) override { inner_->remove(bodies); }

  EngineTimes engine_step() override {
    const double forces = std::pow(lengths_, Dim);  // masses grow so, accelerations stay
    inner_->record_contacts(this->records_contacts());
    for (const Push<Dim>& push : this->pushes()) inner_->push(push.body, forces * push.force);
    for (std::size_t k = 0; k < this->belts().size(); ++k)
      if (this->has_obstacle(static_cast<int>(k)) && this->obstacles()[k].moves)
        inner_->set_surface_velocity(static_cast<int>(k), times_ * this->belts()[k]);
    inner_->step();
    return inner_->times();
  }

  std::optional<BodyIndex> engine_read(BodyStates<Dim>& states) override {
    for (const BodyIndex body : this->awake()) read(body, states);
    return std::nullopt;  // the inner world has thrown
  }
  void read(BodyIndex body, BodyStates<Dim>& states) const {
    const BodyStates<Dim>& from = inner_->states();
    states.pose[body] = outward(from.pose[body]);
    states.velocity[body] = from.velocity[body] / times_;
    states.spin[body] = times_ * from.spin[body];
  }

  void engine_set_velocity(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin) override {
    inner_->set_velocity(body, times_ * velocity, spin / times_);
  }
  void engine_set_grip(BodyIndex body, double grip) override { inner_->set_grip(body, grip); }
  void engine_move_obstacle(int number, const Pose<Dim>& to, const Vec<Dim>& /*velocity*/,
                            const Spin<Dim>& /*spin*/) override {
    inner_->move_obstacle(number, inward(to));
  }
  void engine_remove_obstacle(int number) override { inner_->remove_obstacle(number); }
  void engine_restore_obstacle(int number) override {
    inner_->restore_obstacle(number, inward(this->obstacle_pose(number)));
  }
  void engine_set_gravity(const Vec<Dim>& gravity) override { inner_->set_gravity(gravity); }

  void engine_freeze(std::span<const BodyIndex> bodies) override { inner_->freeze(bodies); }
  void engine_thaw(std::span<const BodyIndex> bodies) override {
    inner_->thaw(bodies);
    for (const BodyIndex body : bodies) read(body, this->writable_states());
  }
  void engine_set_ring(const std::optional<SleepRing>& ring) override {
    std::optional<SleepRing> inner = ring;
    if (inner) inner->extent *= lengths_;
    inner_->set_ring(inner);
  }
  std::span<const BodyIndex> engine_stirred() const override { return inner_->stirred(); }
  bool engine_feels(BodyIndex body, BodyIndex side) const override { return inner_->feels(body, side); }
  void engine_sleeping_contacts(BodyIndex side, std::vector<Contact<Dim>>& found) const override {
    const std::size_t before = found.size();
    inner_->sleeping_contacts(side, found);
    for (Contact<Dim>& contact : std::span(found).subspan(before)) contact = outward(contact);
  }
  int engine_solved_sleepers() const override { return inner_->solved_sleepers(); }
  void engine_share_among(const std::shared_ptr<Team>& team) override { inner_->share_among(team); }

  void engine_query_box(const Box<Dim>& box, std::vector<BodyIndex>& found) const override {
    inner_->query_box({lengths_ * box.min(), lengths_ * box.max()}, found);
  }
  void engine_contacts(std::vector<Contact<Dim>>& contacts) const override {
    for (const Contact<Dim>& contact : inner_->contacts()) contacts.push_back(outward(contact));
  }
  Contact<Dim> outward(Contact<Dim> contact) const {
    const double impulses = std::pow(lengths_, Dim) * times_;
    contact.point /= lengths_;
    contact.normal_impulse /= impulses;
    contact.friction_impulse /= impulses;
    contact.approach_speed /= times_;
    contact.depth /= lengths_;
    return contact;
  }
  bool engine_awake(BodyIndex body) const override { return inner_->states().asleep[body] == 0; }

  std::unique_ptr<World<Dim>> inner_;
  double lengths_;
  double times_;
};

/// A shape in larger units, of the same density; without rounding, unlike scaled(), which computes mass and inertia
/// anew.
template <int Dim>
void enlarge(Shape<Dim>& shape, double lengths) {
  for (Piece<Dim>& piece : shape.pieces) scale(piece, lengths);
  const double volumes = std::pow(lengths, Dim);
  shape.reference *= lengths;
  shape.volume *= volumes;
  shape.mass *= volumes;
  shape.inertia *= volumes * lengths * lengths;
  shape.bounds = Box<Dim>(lengths * shape.bounds.min(), lengths * shape.bounds.max());
  shape.bounding_volume *= volumes;
  shape.extent *= lengths;
}

}  // namespace

template <int Dim>
UnitScale fitting_units(const WorldDescription<Dim>& description) {
  constexpr double narrowest = 0.1;  // [m]
  constexpr double widest = 10.0;
  double width = std::numeric_limits<double>::infinity();  // of the narrowest body
  double part = std::numeric_limits<double>::infinity();   // of the thinnest piece
  for (const Shape<Dim>& shape : description.shapes) {
    width = std::min(width, shape.bounds.sizes().minCoeff());
    part = std::min(part, least_width(shape));
  }
  if (description.shapes.empty() || (width >= narrowest && width <= widest && part >= thinnest_piece<Dim>)) return {};
  const double target = std::max(1.0, 2.0 * thinnest_piece<Dim> * width / part);  // [m]
  return {static_cast<int>(std::lround(0.5 * std::log2(target / width)))};
}

template <int Dim>
WorldDescription<Dim> in_engine_units(const WorldDescription<Dim>& description) {
  const UnitScale units = description.units;
  WorldDescription<Dim> inner = description;
  inner.units = {};
  inner.dt *= units.times();
  inner.solver.restitution_threshold *= units.speeds();
  inner.ground.height *= units.lengths();
  if (inner.periodic_x) *inner.periodic_x *= units.lengths();
  if (inner.periodic_y) *inner.periodic_y *= units.lengths();
  for (Obstacle<Dim>& obstacle : inner.obstacles) {
    enlarge(obstacle.shape, units.lengths());
    obstacle.pose.position *= units.lengths();
  }
  for (Shape<Dim>& shape : inner.shapes) enlarge(shape, units.lengths());
  return inner;
}

template <int Dim>
std::unique_ptr<World<Dim>> make_in_engine_units(const WorldDescription<Dim>& description,
                                                 const WorldMaker<Dim>& make) {
  if (description.units.power == 0) return make_with_sides(description, make);
  check(description);  // in its own units, before the engine's would be in the message
  return std::make_unique<ScaledWorld<Dim>>(description, make_with_sides(in_engine_units(description), make));
}

template UnitScale fitting_units(const WorldDescription<2>&);
template UnitScale fitting_units(const WorldDescription<3>&);
template WorldDescription<2> in_engine_units(const WorldDescription<2>&);
template WorldDescription<3> in_engine_units(const WorldDescription<3>&);
template std::unique_ptr<World<2>> make_in_engine_units(const WorldDescription<2>&, const WorldMaker<2>&);
template std::unique_ptr<World<3>> make_in_engine_units(const WorldDescription<3>&, const WorldMaker<3>&);

}  // namespace talus

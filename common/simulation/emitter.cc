#include "common/simulation/emitter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "common/math/random.h"

namespace talus {
namespace {

// In the units of the engine [m/s]: what moves faster is in flight and does not lift a spout.
constexpr double settled_speed = 1.0;

}  // namespace

template <int Dim>
Emitter<Dim>::Emitter(const Scene<Dim>& scene)
    : obstacles_(static_cast<int>(scene.world.obstacles.size())), total_(static_cast<int>(scene.bodies_planned())) {
  for (const InitialBody<Dim>& body : scene.bodies) initial_.push_back(body.def);
  if (scene.world.ground.present) ground_ = scene.world.ground.height;
  std::uint64_t number = 0;
  for (const Source<Dim>& source : scene.sources) {
    spouts_.push_back({.source = source, .random = generator_of(scene.seed, std::array{number++})});
    if (source.waits_for_event) waiting_ += source.count;
  }
}

template <int Dim>
void Emitter<Dim>::emit(World<Dim>& world, double time) {
  if (finished()) return;
  const double gravity = world.gravity_size();
  const double slow_time = gravity > 0.0 ? settled_speed / world.units().speeds() / gravity : 0.0;  // [s]
  while (!recent_.empty() && recent_.front().time + slow_time <= time) recent_.pop_front();
  for (Spout& spout : spouts_) {
    bool ridden = spout.source.ride_above == 0.0;
    while (due(spout, time)) {
      if (!spout.drawn) draw(spout);
      if (!ridden) ride(world, spout, time);
      ridden = true;
      BodyDef<Dim> body = spout.next;
      body.pose.position += place(spout, time) + place_in_grid(spout);
      if (!has_room(world, body, spout.source.overlap_allowed() / world.units().lengths())) {
        ++waits_;
        break;
      }
      const BodyIndex added = world.add(body);
      if (recent_.empty() || recent_.back().time < time) recent_.push_back({time, added});
      spout.drawn = false;
      ++spout.emitted;
      ++emitted_;
      last_appearance_ = time;
    }
  }
}

template <int Dim>
void Emitter<Dim>::add_initial(World<Dim>& world) {
  for (const BodyDef<Dim>& body : initial_) world.add(body);
  emitted_ += static_cast<int>(initial_.size());
}

template <int Dim>
int Emitter<Dim>::due_by(double time) const {
  const auto add = [time](int sum, const Spout& spout) { return sum + spout.source.due_by(time); };
  return std::accumulate(spouts_.begin(), spouts_.end(), static_cast<int>(initial_.size()), add);
}

template <int Dim>
bool Emitter<Dim>::due(const Spout& spout, double time) const {
  return spout.emitted < spout.source.count && time >= spout.source.due_time(spout.emitted);
}

/// The number of a size, drawn by the shares of the sizes.
template <int Dim>
int Emitter<Dim>::draw_size(Spout& spout) const {
  const std::vector<double>& shares = spout.source.shares;
  if (shares.empty()) return 0;
  const auto found = std::ranges::upper_bound(shares, uniform(spout.random));
  return static_cast<int>(std::min(found, shares.end() - 1) - shares.begin());
}

template <int Dim>
void Emitter<Dim>::start(int source, double time) {
  Source<Dim>& started = spouts_[source].source;
  if (started.waits_for_event) waiting_ -= started.count;
  started.waits_for_event = false;
  started.start = time;
}

template <int Dim>
void Emitter<Dim>::set_rate(int source, double rate, double time) {
  Source<Dim>& changed = spouts_[source].source;
  const int before_its_grid = spouts_[source].emitted - spouts_[source].emitted % changed.bodies_at_once();
  changed.rate = rate;
  changed.start = time - before_its_grid / rate;
}

template <int Dim>
void Emitter<Dim>::draw(Spout& spout) const {
  const Source<Dim>& source = spout.source;
  BodyDef<Dim>& body = spout.next;
  body.shape = source.shapes[draw_size(spout) * source.shapes_of_a_size() + spout.emitted % source.shapes_of_a_size()];
  body.pose.position = uniform_within<Dim>(source.spread, spout.random);
  body.pose.rotation = source.orientation ? *source.orientation : uniform_rotation<Dim>(spout.random);
  body.velocity = source.velocity + uniform_within<Dim>(source.velocity_spread, spout.random);
  constexpr int spin_size = Spin<Dim>::RowsAtCompileTime;
  body.spin = uniform_within<spin_size>(Spin<Dim>::Constant(source.spin_spread), spout.random);
  spout.drawn = true;
}

/// Where the spout is: its swing is a triangle wave that starts at `position` towards + sweep.
template <int Dim>
Vec<Dim> Emitter<Dim>::place(const Spout& spout, double time) const {
  Vec<Dim> at = spout.source.position + spout.lift * Vec<Dim>::Unit(Dim - 1);
  if (spout.source.sweep_period > 0.0) {
    const double turn = (time - spout.source.start) / spout.source.sweep_period + 0.75;
    const double saw = turn - std::floor(turn);
    at += (4.0 * std::abs(saw - 0.5) - 1.0) * spout.source.sweep;
  }
  return at;
}

/// Where in its grid the next body appears, seen from the middle of the lowest rows: x changes first, height last.
template <int Dim>
Vec<Dim> Emitter<Dim>::place_in_grid(const Spout& spout) const {
  const Source<Dim>& source = spout.source;
  Vec<Dim> place = -0.5 * source.grid_extent();
  place[Dim - 1] = 0.0;
  int number = spout.emitted % source.bodies_at_once();
  for (int axis = 0; axis < Dim; ++axis) {
    place[axis] += (number % source.grid[axis]) * source.spacing[axis];
    number /= source.grid[axis];
  }
  return place;
}

template <int Dim>
bool Emitter<Dim>::has_room(const World<Dim>& world, const BodyDef<Dim>& body, double overlap_allowed) {
  Box<Dim> place = bounds_at(world.shapes()[body.shape], body.pose);
  place.min().array() += overlap_allowed;
  place.max().array() -= overlap_allowed;
  near_.clear();
  world.query_box(place, near_);
  return std::ranges::none_of(
      near_, [&](BodyIndex other) { return place.intersects(world.bounds_near(other, body.pose.position)); });
}

/// Lifts the spout so that it stays `ride_above` over whatever has settled in the column beneath it. Bodies appear in
/// the order of their numbers, and the last ones are slow only since they have just appeared.
template <int Dim>
void Emitter<Dim>::ride(const World<Dim>& world, Spout& spout, double time) {
  const Vec<Dim> spout_at = place(spout, time);
  const double half_width = world.shapes()[spout.next.shape].extent;
  const Vec<Dim> reach = Vec<Dim>::Constant(half_width) + spout.source.spread + 0.5 * spout.source.grid_extent();
  Box<Dim> column(spout_at - reach, spout_at + reach);
  column.min()[Dim - 1] = height<Dim>(spout_at) - spout.source.ride_above;
  near_.clear();
  world.query_box(column, near_);
  const BodyStates<Dim>& states = world.states();
  const double settled = settled_speed / world.units().speeds();
  const BodyIndex first_recent = recent_.empty() ? states.size() : recent_.front().body;
  for (const BodyIndex body : near_) {
    if (body >= first_recent || states.velocity[body].norm() > settled) continue;
    const Box<Dim> bounds = world.bounds_of(body);
    const double lift = height<Dim>(bounds.max()) + spout.source.ride_above - height<Dim>(spout.source.position);
    if (lift > spout.lift && lies_on_something(world, body, bounds)) spout.lift = lift;
  }
}

/// A body that an impact has thrown up is slow for a moment too, so its support is checked.
template <int Dim>
bool Emitter<Dim>::lies_on_something(const World<Dim>& world, BodyIndex body, const Box<Dim>& bounds) {
  Box<Dim> beneath = bounds;
  beneath.min()[Dim - 1] -= 0.05 * bounds.sizes()[Dim - 1];
  if (height<Dim>(beneath.min()) < ground_) return true;
  for (int k = 0; k < obstacles_; ++k)
    if (world.has_obstacle(k) && bounds_at(world.obstacle_shape(k), world.obstacle_pose(k)).intersects(beneath))
      return true;
  beneath_.clear();
  world.query_box(beneath, beneath_);
  return std::ranges::any_of(beneath_, [&](BodyIndex other) {
    return other != body && beneath.intersects(world.bounds_near(other, beneath.center()));
  });
}

template class Emitter<2>;
template class Emitter<3>;

}  // namespace talus

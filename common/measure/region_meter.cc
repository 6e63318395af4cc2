#include "common/measure/region_meter.h"

#include <fmt/format.h>

#include <cmath>

#include "common/measure/shape_statistics.h"
#include "common/pile/angle_of_repose.h"
#include "common/world/energy.h"

namespace talus {
namespace {

/// Columns along each horizontal axis, of a body at the region's border and of all obstacles in it.
template <int Dim>
constexpr int body_lines = Dim == 2 ? 64 : 16;
template <int Dim>
constexpr int obstacle_lines = Dim == 2 ? 512 : 64;

constexpr double most_roughness = 1.0;  // [D]; a heap of two flanks departs from a plane by 0.3 of its height

}  // namespace

template <int Dim>
void RegionMeter<Dim>::note_contacts(const World<Dim>& world) {
  touches_ = world.states().asleep;
  for (const Contact<Dim>& contact : world.contacts()) {
    if (contact.normal_impulse == 0.0) continue;
    touches_[contact.a] = 1;
    if (contact.b >= 0) touches_[contact.b] = 1;
  }
}

template <int Dim>
RegionReading RegionMeter<Dim>::read(const World<Dim>& world, double ground) {
  const BodyStates<Dim>& states = world.states();
  images_ = world.periodic().shifts(-1);
  RegionReading reading;
  for (BodyIndex body = 0; body < states.size(); ++body) {
    if (states.removed[body] != 0) continue;
    for (const Vec<Dim>& shift : images_)
      reading.solid_volume += solid_volume(world.shape_of(body), states.shape[body],
                                           {states.pose[body].position + shift, states.pose[body].rotation});
    if (!form_.holds(world.periodic().inside(states.pose[body].position))) continue;
    ++reading.bodies;
    reading.mean_speed += states.velocity[body].norm();
    reading.kinetic_energy += kinetic_energy(world, body);
  }
  if (reading.bodies > 0) reading.mean_speed /= reading.bodies;
  if (!std::isfinite(form_.volume()))
    reading.packing_reason = "a layer has no volume";
  else if (const double free = free_volume(world, ground); free > 1e-9 * form_.volume())
    reading.packing = reading.solid_volume / free;
  else
    reading.packing_reason = "obstacles or the ground fill the region";
  reading.surface = surface(world);
  return reading;
}

template <int Dim>
Applicable<SurfacePlane> RegionMeter<Dim>::surface(const World<Dim>& world) const {
  if (!is_straight_down(world.down())) return {.why_not = "gravity is not vertical"};
  std::vector<PlacedBody<Dim>> inside;
  std::vector<PlacedBody<Dim>> bodies;
  std::vector<std::uint8_t> counted;
  const BodyStates<Dim>& states = world.states();
  for (BodyIndex body = 0; body < std::ssize(touches_); ++body) {
    if (states.removed[body] != 0 || touches_[body] == 0) continue;
    bodies.push_back({.centre = states.pose[body].position, .bounds = world.bounds_of(body)});
    counted.push_back(static_cast<std::uint8_t>(form_.holds(bodies.back().centre)));
    if (counted.back() != 0) inside.push_back(bodies.back());
  }
  if (inside.size() < min_bodies_for_slope)
    return {.why_not = fmt::format("of the bodies inside {} touch something, fewer than {}", inside.size(),
                                   min_bodies_for_slope)};
  Box<Dim> all;
  for (const PlacedBody<Dim>& body : inside) all.extend(body.bounds);
  const SurfacePlane plane =
      surface_plane<Dim>(bodies, counted, grid_around<Dim>(inside, height<Dim>(all.min()), extent_));
  if (plane.cells == 0) return {.why_not = "other bodies lie above those inside"};
  if (!plane.wide) return {.why_not = "the surface is narrower than three strips of D/2"};
  if (plane.roughness > most_roughness * extent_)
    return {.why_not = fmt::format("the surface departs from a plane by {:.2g} D", plane.roughness / extent_)};
  return {.value = plane};
}

/// Of the part inside of a body of this shape and number of the shape. Pieces that stand in for a mesh have another
/// volume than the body.
template <int Dim>
double RegionMeter<Dim>::solid_volume(const Shape<Dim>& shape, int number, const Pose<Dim>& pose) {
  const Vec<Dim>& at = pose.position;
  const Box<Dim> all = form_.bounds();
  const Vec<Dim> around = Vec<Dim>::Constant(shape.extent);  // of any rotation: the centre is within the bounds
  if (!all.intersects(Box<Dim>(at - around, at + around))) return 0.0;
  const Box<Dim> bounds = bounds_at(shape, pose);
  if (form_.holds(bounds) || form_.holds(at, bounding_radius(shape))) return shape.volume;
  if (!all.intersects(bounds)) return 0.0;
  if (std::ssize(pieces_) <= number) pieces_.resize(number + 1);
  if (pieces_[number].empty()) pieces_[number] = convex_pieces(shape);
  placed_.clear();
  for (const ConvexPiece<Dim>& piece : pieces_[number]) placed_.push_back(moved(piece, pose));
  return volume_within<Dim>(form_, placed_, body_lines<Dim>) / shape.filling;
}

template <int Dim>
double RegionMeter<Dim>::free_volume(const World<Dim>& world, double ground) {
  std::vector<int> obstacles;
  bool may_move = false;
  for (int k = 0; k < std::ssize(world.obstacles()); ++k) {
    if (!world.has_obstacle(k)) continue;
    if (!form_.bounds().intersects(bounds_at(world.obstacle_shape(k), world.obstacle_pose(k)))) continue;
    obstacles.push_back(k);
    may_move = may_move || world.obstacles()[k].moves;
  }
  if (free_volume_ && !may_move && obstacles == obstacles_) return *free_volume_;
  std::vector<ConvexPiece<Dim>> pieces;
  for (const int k : obstacles)
    for (ConvexPiece<Dim>& piece : convex_pieces_at(world.obstacle_shape(k), world.obstacle_pose(k)))
      pieces.push_back(std::move(piece));
  obstacles_ = std::move(obstacles);
  free_volume_ = form_.volume() - volume_within<Dim>(form_, pieces, obstacle_lines<Dim>, ground);
  return *free_volume_;
}

template class RegionMeter<2>;
template class RegionMeter<3>;

}  // namespace talus

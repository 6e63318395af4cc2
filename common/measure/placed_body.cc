#include "common/measure/placed_body.h"

namespace talus {
namespace {

template <int Dim>
PlacedBody<Dim> place(const Shape<Dim>& shape, const Pose<Dim>& pose) {
  return {pose.position, bounds_at(shape, pose), shape.volume, shape.mass};
}

/// From the frame before [m/s].
template <int Dim>
double speed_at(const Trajectory<Dim>& run, int frame, BodyIndex body) {
  if (frame == 0 || run.lost(frame - 1)) return 0.0;
  if (!run.present(frame - 1, body)) return std::numeric_limits<double>::infinity();
  return run.way(run.position(frame - 1, body), run.position(frame, body)).norm() / run.frame_time();
}

}  // namespace

template <int Dim>
std::vector<PlacedBody<Dim>> placed_bodies(std::span<const Shape<Dim>> shapes, const BodyStates<Dim>& states,
                                           double fastest) {
  std::vector<PlacedBody<Dim>> bodies;
  for (std::size_t i = 0; i < states.shape.size(); ++i) {
    if (states.removed[i] || states.velocity[i].norm() > fastest) continue;
    bodies.push_back(place(shapes[states.shape[i]], states.pose[i]));
  }
  return bodies;
}

template <int Dim>
std::vector<PlacedBody<Dim>> placed_bodies(std::span<const Shape<Dim>> shapes, const Trajectory<Dim>& run, int frame,
                                           double fastest) {
  std::vector<PlacedBody<Dim>> bodies;
  for (BodyIndex i = 0; i < run.bodies(frame); ++i) {
    if (!run.present(frame, i) || speed_at(run, frame, i) > fastest) continue;
    const Pose<Dim> pose{run.position(frame, i), run.rotation(frame, i)};
    bodies.push_back(place(shapes[run.shape(i)], pose));
  }
  return bodies;
}

template <int Dim>
std::vector<double> radii(std::span<const PlacedBody<Dim>> bodies, const Vec<Dim - 1>& centre) {
  std::vector<double> result;
  result.reserve(bodies.size());
  for (const PlacedBody<Dim>& body : bodies) result.push_back((horizontal<Dim>(body.centre) - centre).norm());
  return result;
}

template <int Dim>
std::vector<double> heights(std::span<const PlacedBody<Dim>> bodies) {
  std::vector<double> result;
  result.reserve(bodies.size());
  for (const PlacedBody<Dim>& body : bodies) result.push_back(height<Dim>(body.centre));
  return result;
}

template std::vector<PlacedBody<2>> placed_bodies(std::span<const Shape<2>>, const BodyStates<2>&, double);
template std::vector<PlacedBody<3>> placed_bodies(std::span<const Shape<3>>, const BodyStates<3>&, double);
template std::vector<PlacedBody<2>> placed_bodies(std::span<const Shape<2>>, const Trajectory<2>&, int, double);
template std::vector<PlacedBody<3>> placed_bodies(std::span<const Shape<3>>, const Trajectory<3>&, int, double);
template std::vector<double> radii<2>(std::span<const PlacedBody<2>>, const Vec<1>&);
template std::vector<double> radii<3>(std::span<const PlacedBody<3>>, const Vec<2>&);
template std::vector<double> heights<2>(std::span<const PlacedBody<2>>);
template std::vector<double> heights<3>(std::span<const PlacedBody<3>>);

}  // namespace talus

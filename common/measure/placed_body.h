#pragma once
// A body as the measures of a pile's shape see it.

#include <limits>
#include <span>
#include <vector>

#include "common/measure/trajectory.h"
#include "common/shape/shape.h"

namespace talus {

template <int Dim>
struct PlacedBody {
  Vec<Dim> centre = Vec<Dim>::Zero();  // of mass [m]
  Box<Dim> bounds;                     // smallest axis-aligned box around it [m]
  double volume = 0.0;                 // solid volume [m^3], in 2D [m^2]
  double mass = 0.0;                   // [kg]
};

/// The bodies of a world that are not removed and not faster than `fastest` [m/s]: with a limit, what still falls is no
/// part of the pile.
template <int Dim>
std::vector<PlacedBody<Dim>> placed_bodies(std::span<const Shape<Dim>> shapes, const BodyStates<Dim>& states,
                                           double fastest = std::numeric_limits<double>::infinity());

/// The bodies present at a frame of a recorded run and, on their way from the frame before, not faster than `fastest`
/// [m/s]. With a limit, a body that was not there yet still falls; where the frame before is lost, none does.
template <int Dim>
std::vector<PlacedBody<Dim>> placed_bodies(std::span<const Shape<Dim>> shapes, const Trajectory<Dim>& run, int frame,
                                           double fastest = std::numeric_limits<double>::infinity());

/// Horizontal distances of the bodies' centres from `centre` [m], and their heights [m].
template <int Dim>
std::vector<double> radii(std::span<const PlacedBody<Dim>> bodies, const Vec<Dim - 1>& centre);
template <int Dim>
std::vector<double> heights(std::span<const PlacedBody<Dim>> bodies);

}  // namespace talus

#pragma once

#include "common/scene/scene.h"

namespace talus {

/// Time [s] after which a body that a source dropped has surely left the place where the next may appear: a whole
/// number of steps, infinite if that never happens. Both bodies count as boxes around the largest shape's bounding
/// sphere, at the ends of `spread` that suit least, the first with the velocity of `velocity_spread` that suits least,
/// the spout following it at the speed of its sweep; the engines' semi-implicit Euler steps and nothing else in the
/// way.
template <int Dim>
double clearing_time(const Source<Dim>& source, const WorldDescription<Dim>& world);

/// Bodies per second that a source really drops: its rate, or one (of a grid: all its bodies) per clearing time if that
/// is less.
template <int Dim>
double reachable_rate(const Source<Dim>& source, const WorldDescription<Dim>& world);

/// The spread of a source whose `spread` is not given [m]: largest_radius() along each horizontal axis on which its
/// grid has one row, else 0. Measured with 60 bodies of seven shapes from 16 radii on each engine: with 0 a spout may
/// build a tower up to itself (8 discs), at half the radius it still may (boxes turned alike), at the radius it makes a
/// pile.
template <int Dim>
Vec<Dim> default_spread(const Source<Dim>& source, const WorldDescription<Dim>& world);

/// The smallest box, seen from the centre of mass, that holds each body of a source at each rotation that it may have
/// when it appears [m].
template <int Dim>
Box<Dim> largest_bounds(const Source<Dim>& source, const WorldDescription<Dim>& world);

/// Bounding radius of the largest shape that a source drops [m].
template <int Dim>
double largest_radius(const Source<Dim>& source, const WorldDescription<Dim>& world);

}  // namespace talus

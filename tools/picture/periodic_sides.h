#pragma once
// What is drawn of periodic sides.

#include <vector>

#include "tools/picture/picture.h"

namespace talus {

/// The same with the images of bodies and obstacles that reach through a side: each is added as another one, where it
/// comes in through the opposite side.
template <int Dim>
PictureInput<Dim> with_images(const PictureInput<Dim>& input);

/// `box`, widened to reach from each side to the opposite one [m].
template <int Dim>
Box<Dim> between_sides(const Periodic<Dim>& sides, Box<Dim> box);

/// For each side the line, in 3D the closed outline, of its part in `box` and between the other sides [m].
template <int Dim>
std::vector<std::vector<Vec<Dim>>> outlines_of(const Periodic<Dim>& sides, const Box<Dim>& box);

}  // namespace talus

#pragma once
// Shapes, obstacles and rotations as text of a scene file.

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace talus {

/// A shape of WorldDescription::shapes as a scene file names it.
struct NamedShape {
  std::string name;       // empty: a size of [source.scale] or a further variant of a stone, which have no names
  std::string base;       // the table that it comes from
  bool own_axes = false;  // its axes begin at the centre of mass
};

/// Those of a scene, in their order.
template <int Dim>
std::vector<NamedShape> named_shapes(const Scene<Dim>& scene);

/// `[shape.NAME]` of a compound of hulls, balls and capsules, in axes that begin at the centre of mass.
template <int Dim>
std::string shape_text(const Shape<Dim>& shape, const std::string& name);

/// `[[obstacle]]` for each piece of an obstacle.
template <int Dim>
std::string obstacle_text(const Shape<Dim>& shape, const Pose<Dim>& pose);

/// `angle_deg`, and in 3D `axis`; nothing where there is no rotation.
std::string turn_text(const Rotation<2>& rotation);
std::string turn_text(const Rotation<3>& rotation);

}  // namespace talus

#pragma once
// Do convex parts fill the mesh for which they stand?

#include <span>

#include "common/mesh/mesh.h"

namespace talus {

/// Largest share of the mesh's volume by which the volume of the parts that `talus decompose` makes may differ from it.
constexpr double parts_tolerance = 0.05;
/// The same for parts that a scene names, which warns from parts_tolerance on: wider, since the bunny's parts in
/// scenes/shapes lack 0.106, but far below what a missing part makes.
constexpr double parts_refused = 0.15;

/// Volume of the union of convex parts that repaired() has passed. The sum of their volumes would count overlaps twice,
/// and the parts of a correct decomposition overlap by a tenth. Measured along 16384 parallel
/// lines, exactly along each: within about 0.2 %, and the same for the same parts.
double union_volume(std::span<const Mesh> parts);

/// The volume of the parts' union over the mesh's.
double volume_ratio(std::span<const Mesh> parts, const Mesh& mesh);

/// Whether a volume ratio lies within `tolerance` of 1.
bool fills_mesh(double ratio, double tolerance = parts_tolerance);

}  // namespace talus

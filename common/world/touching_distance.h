#pragma once

namespace talus {

/// In extents of a body: bodies nearer than this touch. Above the gap that Box2D keeps between polygons and the margin of
/// Bullet's boxes.
inline constexpr double touching_distance = 0.03;

}  // namespace talus

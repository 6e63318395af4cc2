#pragma once
// Flat convex faces in space, what the 3D picture is made of.

#include <cstdint>
#include <optional>
#include <vector>

#include "tools/picture/framing.h"
#include "tools/picture/picture.h"

namespace talus {

/// Those of `bodies` that are no deeper than two extents beneath the lowest surface around them, the surface being the
/// highest body in each column as wide as an extent. All of them, where they are few enough to draw each.
std::vector<BodyIndex> exposed(const PictureInput<3>& input, const std::vector<BodyIndex>& bodies);

/// Owner of a face: a body's index, or one of these.
inline constexpr std::int32_t ground_owner = -1;
inline constexpr std::int32_t obstacle_owner = -2;  // obstacle k as `obstacle_owner - k`

/// The segment in the middle of a ball (both ends the same) or a capsule, in the world's axes.
struct Core {
  Vec3 a;
  Vec3 b;
};

/// Corners counter-clockwise seen from outside.
struct Face {
  std::vector<Vec3> corners;  // [m], in the world's axes
  Vec3 normal;                // unit, outwards
  std::int32_t owner = ground_owner;
  std::optional<Core> core;  // of the round piece that the face stands for

  /// Unit normal to shade with: the face's, or the round piece's so that its faces are not seen.
  Vec3 normal_at(const Vec3& point) const;
};

inline bool is_body(const Face& face) { return face.owner >= 0; }
inline bool is_obstacle(const Face& face) { return face.owner <= obstacle_owner; }

/// Faces of the framed bodies that may be seen (see exposed()) in order, then of the obstacles, then of the ground if
/// there is one.
std::vector<Face> faces_of(const PictureInput<3>& input, const Framing<3>& framing);

}  // namespace talus

#pragma once
// Messages of Foxglove's published schemas (https://github.com/foxglove/foxglove-sdk, MIT), and our own of the package
// talus, as bytes.

#include <span>
#include <string>

#include "common/math/vector.h"
#include "tools/export/protobuf.h"
#include "tools/export/solid.h"
#include "tools/picture/picture_params.h"

namespace talus {

/// A serialised FileDescriptorSet of all types that an exported file has.
std::string foxglove_descriptors();

ProtoMessage timestamp_message(double seconds);
ProtoMessage pose_message(const Pose<3>& pose);
ProtoMessage colour_message(const Colour& colour, double opacity = 1.0);

/// foxglove.FrameTransform of frame `child` in frame "world".
ProtoMessage frame_transform(double seconds, const std::string& child, const Pose<3>& pose);

/// foxglove.TriangleListPrimitive; corners that are equal are written once.
ProtoMessage triangles_message(const TriangleMesh& mesh, const Pose<3>& pose, const Colour& colour);

/// A primitive of a foxglove.SceneEntity and its field there.
struct ScenePrimitive {
  static constexpr int cube = 8;
  static constexpr int cylinder = 10;
  static constexpr int triangles = 12;
  int field = triangles;
  ProtoMessage message;
};

/// A foxglove.CubePrimitive, or with `round` a foxglove.CylinderPrimitive about z.
ScenePrimitive block_message(bool round, const Vec3& centre, const Vec3& size, const Colour& colour, double opacity);

/// A foxglove.SceneEntity that moves with `frame`.
ProtoMessage scene_entity(double seconds, const std::string& frame, const std::string& id,
                          std::span<const ScenePrimitive> primitives);

/// A foxglove.Log of level warning.
ProtoMessage warning_message(double seconds, std::string_view name, std::string_view text);

}  // namespace talus

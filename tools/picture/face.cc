#include "tools/picture/face.h"

#include "common/shape/surface.h"

namespace talus {

namespace {

/// Round shapes get fewer faces where bodies are many, and small in the picture.
int segments_for(std::size_t bodies) { return bodies > 1500 ? 12 : 24; }

void add_faces(std::vector<Face>& faces, const std::vector<Loop<3>>& loops, const Pose<3>& pose, std::int32_t owner) {
  for (const Loop<3>& loop : loops) {
    Face& face = faces.emplace_back();
    face.owner = owner;
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      face.corners.push_back(pose * loop[i]);
      normal += (loop[i] - loop[0]).cross(loop[(i + 1) % loop.size()] - loop[0]);
    }
    face.normal = (pose.rotation * normal).normalized();
  }
}

void add_ground(std::vector<Face>& faces, const Framing<3>& framing, double height) {
  const double reach = 100.0 * framing.box.diagonal().norm();
  Vec3 middle = framing.box.center();
  middle.z() = height;
  Face& face = faces.emplace_back();
  face.normal = Vec3::UnitZ();
  for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
    face.corners.push_back(middle + reach * Vec3(x, y, 0.0));
  }
}

}  // namespace

std::vector<Face> faces_of(const PictureInput<3>& input, const Framing<3>& framing) {
  const int segments = segments_for(framing.drawn.size());
  std::vector<std::vector<Loop<3>>> shapes;
  for (const Shape<3>& shape : input.shapes) {
    shapes.push_back(faces(shape, segments));
  }
  std::vector<Face> all;
  for (const BodyIndex body : framing.drawn) {
    const auto i = static_cast<std::size_t>(body);
    add_faces(all, shapes[static_cast<std::size_t>(input.states.shape[i])], input.states.pose[i], body);
  }
  for (std::size_t k = 0; k < input.obstacles.size(); ++k) {
    const Obstacle<3>& obstacle = input.obstacles[k];
    add_faces(all, faces(obstacle.shape, 48), obstacle.pose, obstacle_owner - static_cast<std::int32_t>(k));
  }
  if (input.ground.present) {
    add_ground(all, framing, input.ground.height);
  }
  return all;
}

}  // namespace talus

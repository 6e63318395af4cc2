#include "tools/picture/z_buffer.h"

#include <limits>

namespace talus {

NearnessPlane::NearnessPlane(const std::vector<Vec3>& corners) {
  // Newell's sum over the edges: a normal that no single degenerate corner can spoil.
  Vec3 normal = Vec3::Zero();
  Vec3 middle = Vec3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& here = corners[i];
    const Vec3& next = corners[(i + 1) % corners.size()];
    normal += Vec3((here.y() - next.y()) * (here.z() + next.z()), (here.z() - next.z()) * (here.x() + next.x()),
                   (here.x() - next.x()) * (here.y() + next.y()));
    middle += here / static_cast<double>(corners.size());
  }
  flat = std::abs(normal.z()) < 1e-9;
  if (!flat) {
    a = -normal.x() / normal.z();
    b = -normal.y() / normal.z();
    c = middle.z() - a * middle.x() - b * middle.y();
  }
}

bool faces_eye(const Face& face, const Projection<3>& projection) {
  return face.normal.dot(projection.towards_eye(face.corners[0])) > 0.0;
}

std::vector<Vec3> projected(const Face& face, const Projection<3>& projection) {
  std::vector<Vec3> result;
  result.reserve(face.corners.size() + 1);
  const bool parallel = projection.distance == 0.0;  // nothing is too near
  const auto room = [&](const Vec3& corner) { return projection.depth(corner) - projection.near_limit(); };
  for (std::size_t i = 0; i < face.corners.size(); ++i) {
    const Vec3& here = face.corners[i];
    if (parallel) {
      result.push_back(projection.project(here));
      continue;
    }
    const Vec3& next = face.corners[(i + 1) % face.corners.size()];
    if (room(here) > 0.0) result.push_back(projection.project(here));
    if ((room(here) > 0.0) != (room(next) > 0.0))
      result.push_back(projection.project(here + (next - here) * (room(here) / (room(here) - room(next)))));
  }
  return result;
}

ZBuffer::ZBuffer(int width, int height)
    : width_(width),
      height_(height),
      nearness_(static_cast<std::size_t>(width) * height, -std::numeric_limits<float>::infinity()),
      face_(nearness_.size(), nothing) {}

void ZBuffer::add(const Face& face, std::int32_t number, const Projection<3>& projection) {
  scan_convex(projected(face, projection), width_, height_, [&](int x, int y, double nearness) {
    const auto value = static_cast<float>(nearness);
    const std::size_t at = index(x, y);
    if (value > nearness_[at]) {
      nearness_[at] = value;
      face_[at] = number;
    }
  });
}

}  // namespace talus

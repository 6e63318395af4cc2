#include "tools/picture/face.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/shape/surface.h"

namespace talus {
namespace {

constexpr std::size_t few = 100000;  // drawn within half a minute
constexpr double skin = 2.0;         // [extents]
constexpr int most_columns = 4096;   // on each axis

/// The highest body in each column, as a map over the ground.
class HighestBodies {
 public:
  HighestBodies(const Box<3>& box, double width)
      : low_(box.min()),
        width_(std::max(width, box.sizes().head<2>().maxCoeff() / most_columns)),
        columns_(place(box.max().x(), 0) + 1),
        rows_(place(box.max().y(), 1) + 1),
        top_(static_cast<std::size_t>(columns_) * rows_, empty) {}

  void raise(const Vec3& at) {
    double& top = top_[index(place(at.x(), 0), place(at.y(), 1))];
    top = std::max(top, at.z());
  }

  /// The lowest top among a point's column and those around it; columns outside the map are empty.
  double lowest_around(const Vec3& at) const {
    double lowest = std::numeric_limits<double>::infinity();
    for (int x = place(at.x(), 0) - 1; x <= place(at.x(), 0) + 1; ++x) {
      for (int y = place(at.y(), 1) - 1; y <= place(at.y(), 1) + 1; ++y) {
        const bool inside = x >= 0 && y >= 0 && x < columns_ && y < rows_;
        lowest = std::min(lowest, inside ? top_[index(x, y)] : empty);
      }
    }
    return lowest;
  }

 private:
  static constexpr double empty = -std::numeric_limits<double>::infinity();
  int place(double at, int axis) const { return static_cast<int>(std::floor((at - low_[axis]) / width_)); }
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * columns_ + x; }

  Vec3 low_;
  double width_;
  int columns_;
  int rows_;
  std::vector<double> top_;
};

}  // namespace

std::vector<BodyIndex> exposed(const PictureInput<3>& input, const std::vector<BodyIndex>& bodies) {
  if (bodies.size() <= few) return bodies;
  const auto at = [&](BodyIndex body) { return input.states.pose[body].position; };
  double extent = 0.0;
  for (const Shape<3>& shape : input.shapes) extent = std::max(extent, shape.extent);
  Box<3> box;
  for (const BodyIndex body : bodies) box.extend(at(body));
  HighestBodies surface(box, extent);
  for (const BodyIndex body : bodies) surface.raise(at(body));
  std::vector<BodyIndex> seen;
  std::ranges::copy_if(bodies, std::back_inserter(seen), [&](BodyIndex body) {
    return !(at(body).z() < surface.lowest_around(at(body)) - skin * extent);
  });
  return seen;
}

namespace {

/// Round shapes get fewer faces where bodies are many, and small in the picture.
int segments_for(std::size_t bodies) { return bodies > 1500 ? 12 : 24; }

/// The faces of a shape, in its own axes.
std::vector<Face> faces_of(const Shape<3>& shape, int segments) {
  std::vector<Face> all;
  for (const Piece<3>& piece : shape.pieces) {
    Shape<3> alone;
    alone.pieces.push_back(piece);
    std::optional<Core> core;
    if (const HullPiece<3> hull = as_hull(piece); hull.round()) core = {hull.corners.front(), hull.corners.back()};
    for (const Loop<3>& loop : faces(alone, segments)) {
      Vec3 normal = Vec3::Zero();
      for (std::size_t i = 0; i < loop.size(); ++i)
        normal += (loop[i] - loop[0]).cross(loop[(i + 1) % loop.size()] - loop[0]);
      all.push_back({loop, normal.normalized(), 0, core});
    }
  }
  return all;
}

void add_faces(std::vector<Face>& all, const std::vector<Face>& shape, const Pose<3>& pose, std::int32_t owner) {
  for (const Face& face : shape) {
    Face& placed = all.emplace_back(face);
    placed.owner = owner;
    placed.normal = pose.rotation * face.normal;
    for (Vec3& corner : placed.corners) corner = pose * corner;
    if (face.core) placed.core = {pose * face.core->a, pose * face.core->b};
  }
}

void add_ground(std::vector<Face>& faces, const Framing<3>& framing, double height) {
  const double reach = 100.0 * framing.box.diagonal().norm();
  Vec3 middle = framing.box.center();
  middle.z() = height;
  Face& face = faces.emplace_back();
  face.normal = Vec3::UnitZ();
  for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
    face.corners.push_back(middle + reach * Vec3(x, y, 0.0));
}

}  // namespace

Vec3 Face::normal_at(const Vec3& point) const {
  if (!core) return normal;
  const Vec3 along = core->b - core->a;
  const double length = along.squaredNorm();
  const double share = length > 0.0 ? std::clamp((point - core->a).dot(along) / length, 0.0, 1.0) : 0.0;
  return (point - core->a - share * along).normalized();
}

std::vector<Face> faces_of(const PictureInput<3>& input, const Framing<3>& framing) {
  const int segments = segments_for(framing.drawn.size());
  std::vector<std::vector<Face>> shapes;
  for (const Shape<3>& shape : input.shapes) shapes.push_back(faces_of(shape, segments));
  std::vector<Face> all;
  for (const BodyIndex body : exposed(input, framing.drawn))
    add_faces(all, shapes[input.states.shape[body]], input.states.pose[body], body);
  for (std::size_t k = 0; k < input.obstacles.size(); ++k) {
    const Obstacle<3>& obstacle = input.obstacles[k];
    add_faces(all, faces_of(obstacle.shape, 48), obstacle.pose, obstacle_owner - static_cast<std::int32_t>(k));
  }
  if (input.ground.present) add_ground(all, framing, input.ground.height);
  return all;
}

}  // namespace talus

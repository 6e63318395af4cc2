#include "tools/picture/exposed.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
  if (bodies.size() <= few) {
    return bodies;
  }
  const auto at = [&](BodyIndex body) { return input.states.pose[body].position; };
  double extent = 0.0;
  for (const Shape<3>& shape : input.shapes) {
    extent = std::max(extent, shape.extent);
  }
  Box<3> box;
  for (const BodyIndex body : bodies) {
    box.extend(at(body));
  }
  HighestBodies surface(box, extent);
  for (const BodyIndex body : bodies) {
    surface.raise(at(body));
  }
  std::vector<BodyIndex> seen;
  std::ranges::copy_if(bodies, std::back_inserter(seen), [&](BodyIndex body) {
    return !(at(body).z() < surface.lowest_around(at(body)) - skin * extent);
  });
  return seen;
}

}  // namespace talus

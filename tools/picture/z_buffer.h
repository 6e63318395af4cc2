#pragma once
// Which face is seen in each pixel.

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/picture/face.h"
#include "tools/picture/projection.h"

namespace talus {

/// Calls visit(x, y, nearness) for each pixel whose middle lies inside a convex polygon on the page. Polygons that
/// share an edge share no pixel. `corners` are projected: page position and nearness.
template <typename Visit>
void scan_convex(const std::vector<Vec3>& corners, int width, int height, Visit&& visit);

/// For each pixel the nearest face seen so far.
class ZBuffer {
 public:
  static constexpr std::int32_t nothing = -1;

  ZBuffer(int width, int height);

  /// Enters a face, as seen with `projection`, under a number >= 0.
  void add(const Face& face, std::int32_t number, const Projection<3>& projection);

  int width() const { return width_; }
  int height() const { return height_; }
  float nearness(int x, int y) const { return nearness_[index(x, y)]; }
  std::int32_t face(int x, int y) const { return face_[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  int width_;
  int height_;
  std::vector<float> nearness_;
  std::vector<std::int32_t> face_;
};

/// Whether the face's outside is turned to the eye.
bool faces_eye(const Face& face, const Projection<3>& projection);

/// The face's corners on the page, cut off where they come too near to the eye. Empty if nothing is left.
std::vector<Vec3> projected(const Face& face, const Projection<3>& projection);

/// The nearness of the plane through projected corners at page position (x, y) is a x + b y + c.
struct NearnessPlane {
  explicit NearnessPlane(const std::vector<Vec3>& corners);
  bool flat = false;  // seen edge on: covers no pixel
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;
};

template <typename Visit>
void scan_convex(const std::vector<Vec3>& corners, int width, int height, Visit&& visit) {
  const NearnessPlane plane(corners);
  if (corners.size() < 3 || plane.flat) return;
  double top = corners[0].y();
  double bottom = top;
  for (const Vec3& corner : corners) {
    top = std::min(top, corner.y());
    bottom = std::max(bottom, corner.y());
  }
  // Row y covers a height of y + 0.5; pixel x a width of x + 0.5.
  const int first_row = static_cast<int>(std::ceil(std::clamp(top - 0.5, 0.0, static_cast<double>(height))));
  const int last_row = static_cast<int>(std::ceil(std::clamp(bottom - 0.5, 0.0, static_cast<double>(height))));
  for (int y = first_row; y < last_row; ++y) {
    const double level = y + 0.5;
    double left = width;
    double right = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3& a = corners[i];
      const Vec3& b = corners[(i + 1) % corners.size()];
      if ((a.y() <= level) != (b.y() <= level)) {
        const double x = a.x() + (b.x() - a.x()) * (level - a.y()) / (b.y() - a.y());
        left = std::min(left, x);
        right = std::max(right, x);
      }
    }
    const int first = static_cast<int>(std::ceil(std::clamp(left - 0.5, 0.0, static_cast<double>(width))));
    const int last = static_cast<int>(std::ceil(std::clamp(right - 0.5, 0.0, static_cast<double>(width))));
    for (int x = first; x < last; ++x) visit(x, y, plane.a * (x + 0.5) + plane.b * level + plane.c);
  }
}

}  // namespace talus

#include "common/mesh/face_triangles.h"

#include <algorithm>

#include "common/shape/polygon.h"

namespace talus {
namespace {

// The face seen against its normal, so that it runs counter-clockwise.
std::vector<Vec2> flattened(std::span<const int> face, std::span<const Vec3> corners) {
  const auto corner = [&](std::size_t i) { return corners[face[i % face.size()]]; };
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 0; i < face.size(); ++i) {
    normal += (corner(i) - corner(0)).cross(corner(i + 1) - corner(0));
  }
  const Vec3 right = normal.norm() > 0.0 ? normal.unitOrthogonal() : Vec3::UnitX();
  const Vec3 up = normal.norm() > 0.0 ? Vec3(normal.normalized().cross(right)) : Vec3::UnitY();
  std::vector<Vec2> flat;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vec3 from_first = corner(i) - corner(0);
    flat.emplace_back(right.dot(from_first), up.dot(from_first));
  }
  return flat;
}

bool in_triangle(const Vec2& point, const Vec2& a, const Vec2& b, const Vec2& c) {
  const bool within = cross(a, b, point) >= 0.0 && cross(b, c, point) >= 0.0 && cross(c, a, point) >= 0.0;
  return within && point != a && point != b && point != c;
}

// The corners that are left, as places in `flat`, and the current one.
bool is_ear(const std::vector<std::size_t>& left, std::size_t at, const std::vector<Vec2>& flat) {
  const Vec2& before = flat[left[(at + left.size() - 1) % left.size()]];
  const Vec2& here = flat[left[at]];
  const Vec2& after = flat[left[(at + 1) % left.size()]];
  return cross(before, here, after) > 0.0 && std::none_of(left.begin(), left.end(), [&](std::size_t other) {
           return in_triangle(flat[other], before, here, after);
         });
}

}  // namespace

std::vector<std::array<int, 3>> face_triangles(std::span<const int> face, std::span<const Vec3> corners) {
  const std::vector<Vec2> flat = flattened(face, corners);
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < face.size(); ++i) {
    left.push_back(i);
  }
  std::vector<std::array<int, 3>> triangles;
  // Of a face that does not cross itself, clipping an ear can make ears of its two neighbours only (O'Rourke 1998).
  std::vector<bool> no_ear(face.size(), false);
  std::size_t at = 1;
  std::size_t tried = 0;
  while (left.size() >= 3) {
    at %= left.size();
    // What has no ear is flat or crosses itself; any corner will do then.
    if (tried < left.size() && left.size() > 3 && (no_ear[left[at]] || !is_ear(left, at, flat))) {
      no_ear[left[at]] = true;
      ++at;
      ++tried;
      continue;
    }
    const std::size_t size = left.size();
    const std::size_t before = left[(at + size - 1) % size];
    const std::size_t after = left[(at + 1) % size];
    triangles.push_back({face[before], face[left[at]], face[after]});
    no_ear[before] = no_ear[after] = false;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    tried = tried < size ? 0 : tried;
  }
  return triangles;
}

}  // namespace talus

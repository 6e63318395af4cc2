#include "tools/serve/free_place.h"

#include <algorithm>

#include "common/shape/convex_distance.h"

namespace talus {
namespace {

constexpr int most_tries = 1000;

template <int Dim>
using Pieces = std::vector<ConvexPiece<Dim>>;

template <int Dim>
bool apart(const Pieces<Dim>& own, const Shape<Dim>& shape, const Pose<Dim>& pose, double gap) {
  const Pieces<Dim> others = convex_pieces_at(shape, pose);
  return std::ranges::all_of(own, [&](const ConvexPiece<Dim>& a) {
    return std::ranges::all_of(others,
                               [&](const ConvexPiece<Dim>& b) { return signed_distance(a, b, 2.0 * gap) > gap; });
  });
}

template <int Dim>
bool is_free(const World<Dim>& world, const FixedSupports& fixed, const Shape<Dim>& shape, const Pose<Dim>& pose) {
  const double gap = 0.02 * shape.extent;
  const Box<Dim> bounds = bounds_at(shape, pose);
  const Box<Dim> wide(bounds.min() - Vec<Dim>::Constant(gap), bounds.max() + Vec<Dim>::Constant(gap));
  if (fixed.ground && height<Dim>(wide.min()) < fixed.ground_height) return false;
  const Pieces<Dim> own = convex_pieces_at(shape, pose);
  for (int k = 0; k < fixed.obstacles; ++k)
    if (world.has_obstacle(k) && !apart(own, world.obstacle_shape(k), world.obstacle_pose(k), gap)) return false;
  std::vector<BodyIndex> near;
  world.query_box(wide, near);
  return std::ranges::all_of(near, [&](BodyIndex other) {
    return apart(own, world.shape_of(other), world.pose_near(other, pose.position), gap);
  });
}

}  // namespace

template <int Dim>
std::optional<Vec<Dim>> free_place(const World<Dim>& world, const FixedSupports& fixed, int shape,
                                   const Vec<Dim>& place) {
  const Shape<Dim>& added = world.shapes()[shape];
  for (int tries = 0; tries < most_tries; ++tries) {
    Pose<Dim> pose;
    pose.position = place + 0.1 * tries * added.extent * Vec<Dim>::Unit(Dim - 1);
    if (is_free(world, fixed, added, pose)) return pose.position;
  }
  return std::nullopt;
}

template std::optional<Vec2> free_place(const World<2>&, const FixedSupports&, int, const Vec2&);
template std::optional<Vec3> free_place(const World<3>&, const FixedSupports&, int, const Vec3&);

}  // namespace talus

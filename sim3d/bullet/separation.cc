#include "sim3d/bullet/separation.h"

namespace talus::bullet {
namespace {

/// Share of the boxes' extents that single precision could be wrong by, and much more.
constexpr btScalar clearance = 1e-4F;

}  // namespace

bool apart_along(BoxAxis axis, const btBoxShape& first, const btTransform& first_place, const btBoxShape& second,
                 const btTransform& second_place) {
  const bool of_first = axis < 3;
  const int column = of_first ? axis : axis - 3;
  const btVector3 direction = (of_first ? first_place : second_place).getBasis().getColumn(column);
  const btVector3 across = direction * (of_first ? second_place : first_place).getBasis();  // in the other's axes
  const btVector3 own_half = (of_first ? first : second).getHalfExtentsWithMargin();
  const btVector3 other_half = (of_first ? second : first).getHalfExtentsWithMargin();
  const btScalar reach = own_half[column] + across.absolute().dot(other_half);
  const btScalar distance = btFabs((second_place.getOrigin() - first_place.getOrigin()).dot(direction));
  return distance - reach > clearance * (distance + reach);
}

BoxAxis separating_axis(const btBoxShape& first, const btTransform& first_place, const btBoxShape& second,
                        const btTransform& second_place) {
  for (BoxAxis axis = 0; axis < 6; ++axis) {
    if (apart_along(axis, first, first_place, second, second_place)) {
      return axis;
    }
  }
  return -1;
}

}  // namespace talus::bullet

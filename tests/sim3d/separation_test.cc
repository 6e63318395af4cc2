// Whether boxes are told apart along their edges' directions as their corners' shadows say.

#include "sim3d/bullet/separation.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>

namespace talus::bullet {
namespace {

btScalar number(btScalar low, btScalar high) {
  return low + (high - low) * static_cast<btScalar>(*rc::gen::inRange(0, 1001)) / 1000;
}

struct PlacedBox {
  btBoxShape shape{btVector3(number(0.1F, 1), number(0.1F, 1), number(0.1F, 1))};
  btTransform place{btQuaternion(number(-1, 1), number(-1, 1), number(-1, 1), number(0.1F, 1)).normalized(),
                    btVector3(number(-1.5F, 1.5F), number(-1.5F, 1.5F), number(-1.5F, 1.5F))};
};

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

/// Of the box's eight corners along a direction.
Interval shadow(const PlacedBox& box, const btVector3& direction) {
  Interval interval;
  const btVector3 half = box.shape.getHalfExtentsWithMargin();
  for (int i = 0; i < 8; ++i) {
    const btVector3 sides((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    const double at = (box.place * (half * sides)).dot(direction);
    interval.low = std::min(interval.low, at);
    interval.high = std::max(interval.high, at);
  }
  return interval;
}

/// Negative where the shadows overlap [m].
double gap(const PlacedBox& a, const PlacedBox& b, BoxAxis axis) {
  const btVector3 direction = (axis < 3 ? a : b).place.getBasis().getColumn(axis < 3 ? axis : axis - 3);
  const Interval first = shadow(a, direction);
  const Interval second = shadow(b, direction);
  return std::max(first.low - second.high, second.low - first.high);
}

// Extents are at most 4 m, and a clearance is 1e-4 of them at most.
RC_GTEST_PROP(SeparatingAxis, IsOneWhereTheShadowsAreApart, ()) {
  const PlacedBox a;
  const PlacedBox b;
  const BoxAxis found = separating_axis(a.shape, a.place, b.shape, b.place);
  if (found >= 0)
    RC_ASSERT(gap(a, b, found) > 0.0);
  else
    for (BoxAxis axis = 0; axis < 6; ++axis) RC_ASSERT(gap(a, b, axis) < 1e-3);
}

TEST(SeparatingAxis, IsNoneWhereBoxesOnlyTouch) {
  const btBoxShape cube(btVector3(0.5F, 0.5F, 0.5F));
  const btTransform here = btTransform::getIdentity();
  EXPECT_EQ(separating_axis(cube, here, cube, btTransform(btQuaternion::getIdentity(), btVector3(1, 0, 0))), -1);
  EXPECT_EQ(separating_axis(cube, here, cube, btTransform(btQuaternion::getIdentity(), btVector3(0, 1.01F, 0))), 1);
}

}  // namespace
}  // namespace talus::bullet

#pragma once
// Whether two boxes, or two polyhedra, are apart, found from where they were apart before.

#include <BulletCollision/CollisionShapes/btConvexPolyhedron.h>
#include <btBulletCollisionCommon.h>

#include <cstdint>

namespace talus::bullet {

/// Number of an edge direction: 0 to 2 of the first box, 3 to 5 of the second; -1: none.
using BoxAxis = std::int16_t;

/// Whether the boxes' shadows on this axis (not -1) are apart by more than the rounding of any test of it.
bool apart_along(BoxAxis axis, const btBoxShape& first, const btTransform& first_place, const btBoxShape& second,
                 const btTransform& second_place);

/// An axis along which they are apart; -1 where there is none, though they may still be apart along a direction
/// across two of their edges. (Gottschalk, Lin and Manocha 1996, "OBBTree", section 5.)
BoxAxis separating_axis(const btBoxShape& first, const btTransform& first_place, const btBoxShape& second,
                        const btTransform& second_place);

/// Number of a face: those of the first polyhedron, then those of the second; -1: none.
using FaceAxis = std::int16_t;

/// A convex polyhedron in the world; null: a shape without corners and faces.
struct PlacedPolyhedron {
  const btConvexPolyhedron* shape;
  const btTransform& place;
};

/// Whether the whole of one polyhedron lies further outside of this face (not -1) of the other than `gap` [m], by more
/// than rounding.
bool apart_along(FaceAxis face, const PlacedPolyhedron& first, const PlacedPolyhedron& second, btScalar gap);

/// A face outside of which the other polyhedron lies by more than `gap`; -1 where there is none.
FaceAxis separating_face(const PlacedPolyhedron& first, const PlacedPolyhedron& second, btScalar gap);

}  // namespace talus::bullet

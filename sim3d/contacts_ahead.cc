#include "sim3d/contacts_ahead.h"

#include <BulletCollision/CollisionShapes/btConvexPolyhedron.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btPolyhedralContactClipping.h>

#include "sim3d/conversions.h"

namespace talus::bullet {
namespace {

/// A convex piece of a mover.
struct Piece {
  const Mover* of;
  const btConvexShape* shape;
  btTransform place;  // in the axes of the object

  btTransform after(float share) const { return of->after(share) * place; }
};

/// How far a piece reaches along a direction at the start of the step [m].
btScalar reach(const Piece& piece, const btVector3& direction) {
  const btTransform place = piece.after(0.0F);
  return direction.dot(place * piece.shape->localGetSupportingVertex(direction * place.getBasis()));
}

/// Whether two pieces stay apart along the line between their middles: a test of one direction that spares most pairs
/// the search.
bool stay_apart(const Piece& a, const Piece& b, float turns) {
  const btVector3 between = b.after(0.0F).getOrigin() - a.after(0.0F).getOrigin();
  if (between.fuzzyZero()) return false;
  const btVector3 line = between.normalized();
  const btScalar gap = -reach(b, -line) - reach(a, line);
  return gap > line.dot(from_solver<3>(a.of->motion.way - b.of->motion.way)) + turns;
}

/// Of a box on its way.
SweptBox swept(const SweptBox& from, const VecF<3>& way, float turn) {
  SweptBox box = from;
  box.low.setMin(from.low + from_solver<3>(way));
  box.high.setMax(from.high + from_solver<3>(way));
  const btVector3 around(turn, turn, turn);
  return {box.low - around, box.high + around};
}

bool overlap(const SweptBox& a, const SweptBox& b) { return TestAabbAgainstAabb2(a.low, a.high, b.low, b.high); }

std::vector<Piece> pieces_of(const Mover& mover) {
  const btCollisionShape* whole = mover.object->getCollisionShape();
  if (!whole->isCompound()) return {{&mover, static_cast<const btConvexShape*>(whole), btTransform::getIdentity()}};
  std::vector<Piece> pieces;
  const auto& compound = *static_cast<const btCompoundShape*>(whole);
  for (int i = 0; i < compound.getNumChildShapes(); ++i)
    pieces.push_back(
        {&mover, static_cast<const btConvexShape*>(compound.getChildShape(i)), compound.getChildTransform(i)});
  return pieces;
}

/// Bullet's first shape is our second, so that Bullet's normal has the direction of ours.
btPointCollector nearest(const Piece& a, const Piece& b, float share) {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btGjkPairDetector detector(b.shape, a.shape, &simplex, &depth);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = b.after(share);
  input.m_transformB = a.after(share);
  btPointCollector found;
  detector.getClosestPoints(input, found, nullptr);
  return found;
}

/// Points of Bullet's in its own form.
struct Points final : btDiscreteCollisionDetectorInterface::Result {
  struct Point {
    btVector3 normal;
    btVector3 on_a;
    btScalar gap;
  };
  std::vector<Point> all;

  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
  void addContactPoint(const btVector3& normal, const btVector3& on_a, btScalar gap) override {
    all.push_back({normal, on_a, gap});
  }
};

const btConvexPolyhedron* polyhedron(const Piece& piece) {
  return piece.shape->isPolyhedral() ? static_cast<const btPolyhedralConvexShape*>(piece.shape)->getConvexPolyhedron()
                                     : nullptr;
}

/// All points of the faces that look at each other, no further apart than `reach`; else the nearest.
Points points_at(const Piece& a, const Piece& b, float share, float reach) {
  Points points;
  const btPointCollector near = nearest(a, b, share);
  if (!near.m_hasResult) return points;
  if (polyhedron(a) != nullptr && polyhedron(b) != nullptr) {
    btVertexArray one;
    btVertexArray other;
    btPolyhedralContactClipping::clipHullAgainstHull(near.m_normalOnBInWorld, *polyhedron(b), *polyhedron(a),
                                                     b.after(share), a.after(share), near.m_distance, reach, one, other,
                                                     points);
  }
  if (points.all.empty()) points.addContactPoint(near.m_normalOnBInWorld, near.m_pointInWorld, near.m_distance);
  return points;
}

void meet(const Piece& a, const Piece& b, float near, std::vector<ContactPoint<3>>& found) {
  const float turns = a.of->turn + b.of->turn;
  if (stay_apart(a, b, turns)) return;
  const std::optional<float> share =
      first_touch<3>(a.of->motion, b.of->motion, turns, near, [&](float at) -> PieceGap<3> {
        const btPointCollector found_nearest = nearest(a, b, at);
        return {found_nearest.m_hasResult ? found_nearest.m_distance : 0.0F,
                to_solver<3>(found_nearest.m_normalOnBInWorld)};
      });
  if (!share) return;
  const float rest = (1.0F - *share) * ((a.of->motion.way - b.of->motion.way).norm() + turns);
  const btVector3 centre_a = a.of->after(*share).getOrigin();
  const btVector3 centre_b = b.of->after(*share).getOrigin();
  for (const Points::Point& each : points_at(a, b, *share, rest).all) {
    ContactPoint<3> point;
    point.normal = to_solver<3>(each.normal);
    point.gap = each.gap;
    point.arm_a = to_solver<3>(each.on_a - centre_a);
    point.arm_b = to_solver<3>(each.on_a + each.gap * each.normal - centre_b);
    point.gap -= *share * point.opening(a.of->motion, b.of->motion);
    found.push_back(point);
  }
}

}  // namespace

btTransform Mover::after(float share) const {
  if (share == 0.0F) return object->getWorldTransform();
  btTransform moved;
  btTransformUtil::integrateTransform(object->getWorldTransform(), from_solver<3>(motion.way),
                                      from_solver<3>(motion.turn), share, moved);
  return moved;
}

SweptBox swept(const Mover& mover) {
  SweptBox box;
  mover.object->getCollisionShape()->getAabb(mover.object->getWorldTransform(), box.low, box.high);
  return swept(box, mover.motion.way, mover.turn);
}

void meet(const Mover& a, const Mover& b, float near, std::vector<ContactPoint<3>>& found) {
  if (!overlap(swept({b.object, {b.motion.way - a.motion.way, SpinF<3>::Zero()}, a.turn + b.turn}),
               swept({a.object, {}, 0.0F})))
    return;
  const std::vector<Piece> others = pieces_of(b);
  for (const Piece& one : pieces_of(a))
    for (const Piece& other : others) meet(one, other, near, found);
}

}  // namespace talus::bullet

#include "sim3d/bullet/compound_pair.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btCompoundCompoundCollisionAlgorithm.h>

#include <algorithm>

#include "sim3d/bullet/fetch.h"

namespace talus::bullet {
namespace {

// The dispatcher takes memory for algorithms from a pool whose places are as large as Bullet's largest.
static_assert(sizeof(CompoundPair) <= sizeof(btCompoundCompoundCollisionAlgorithm));

const btCompoundShape& compound(const btCollisionObjectWrapper& side) {
  return *static_cast<const btCompoundShape*>(side.getCollisionShape());
}

const btDbvtNode& tree(const CompoundPair::Side& side) { return *compound(side.whole).getDynamicAabbTree()->m_root; }

bool is_box(const WorldPiece& piece) { return piece.shape->getShapeType() == BOX_SHAPE_PROXYTYPE; }
const btBoxShape& box(const WorldPiece& piece) { return *static_cast<const btBoxShape*>(piece.shape); }

/// Null: the piece has no corners.
const btConvexPolyhedron* polyhedron(const WorldPiece& piece) {
  return piece.shape->isPolyhedral() ? static_cast<const btPolyhedralConvexShape*>(piece.shape)->getConvexPolyhedron()
                                     : nullptr;
}

}  // namespace

struct CompoundPair::Visit {
  Visit(const Side& one, const Side& other, const btDispatcherInfo& dispatcher_info, btManifoldResult& into)
      : first(one), second(other), info(dispatcher_info), result(into) {
    const btTransform second_in_first = one.whole.getWorldTransform().inverse() * other.whole.getWorldTransform();
    origin = lanes(second_in_first.getOrigin());
    for (int i = 0; i < 3; ++i) {
      column[i] = lanes(second_in_first.getBasis().getColumn(i));
      size[i] = absolute(column[i]);
    }
  }

  /// Whether a box of the first body's tree overlaps the box around one of the second's, as btTransformAabb makes it.
  bool overlap(const btDbvtAabbMm& a, const btDbvtAabbMm& b) const {
    const btVector3 half = btScalar(0.5) * (b.Maxs() - b.Mins());
    const btVector3 middle = btScalar(0.5) * (b.Maxs() + b.Mins());
    const Lanes centre =
        column[0] * splat(middle.x()) + column[1] * splat(middle.y()) + column[2] * splat(middle.z()) + origin;
    const Lanes extent = size[0] * splat(half.x()) + size[1] * splat(half.y()) + size[2] * splat(half.z());
    return all_at_most(load(a.Mins()), centre + extent, centre - extent, load(a.Maxs()));
  }

  const Side& first;
  const Side& second;
  const btDispatcherInfo& info;
  btManifoldResult& result;
  Lanes column[3] = {splat(0), splat(0), splat(0)};  // of the transform from the second body's axes to the first's
  Lanes size[3] = {splat(0), splat(0), splat(0)};    // the same without signs
  Lanes origin = splat(0);
};

btCollisionAlgorithm* CompoundPair::Maker::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                                    const btCollisionObjectWrapper*,
                                                                    const btCollisionObjectWrapper*) {
  return new (info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(CompoundPair)))
      CompoundPair(info.m_dispatcher1, *this);
}

CompoundPair::~CompoundPair() {
  for (const PiecePair& pair : pieces_) destroy(pair.algorithm);
}

void CompoundPair::destroy(btCollisionAlgorithm* algorithm) {
  algorithm->~btCollisionAlgorithm();
  m_dispatcher->freeCollisionAlgorithm(algorithm);
}

// The caller may put points into them.
void CompoundPair::getAllContactManifolds(btManifoldArray& manifolds) {
  for (PiecePair& pair : pieces_) {
    pair.algorithm->getAllContactManifolds(manifolds);
    pair.may_touch = true;
  }
}

// For callers that do not place the pieces: restoring contacts (WarmStart).
void CompoundPair::processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
                                    const btDispatcherInfo& info, btManifoldResult* result) {
  maker_.first.place(compound(*first), first->getWorldTransform());
  maker_.second.place(compound(*second), second->getWorldTransform());
  collide({*first, maker_.first}, {*second, maker_.second}, info, *result);
}

void CompoundPair::collide(const Side& first, const Side& second, const btDispatcherInfo& info,
                           btManifoldResult& result) {
  follow(first, second, info, result);
  part(first, second);
}

void CompoundPair::follow(const Side& first, const Side& second, const btDispatcherInfo& info,
                          btManifoldResult& result) {
  refresh(result);
  if (pieces_overlap(first.placed, second.placed))
    descend(tree(first), tree(second), Visit(first, second, info, result));
}

bool CompoundPair::is_steady(const PlacedBody& first, const PlacedBody& second) const {
  for (const PiecePair& pair : pieces_)
    if (pair.manifold == nullptr || !overlap(first.pieces[pair.first].box, second.pieces[pair.second].box))
      return false;
  std::size_t near = 0;
  for (const WorldPiece& a : first.pieces)
    for (const WorldPiece& b : second.pieces) near += overlap(a.box, b.box) ? 1 : 0;
  return near == pieces_.size();
}

void CompoundPair::fetch_points() const {
  for (const PiecePair& pair : pieces_)
    if (pair.may_touch && pair.manifold != nullptr) bullet::fetch(*pair.manifold);
}

// Follows the known points to where the bodies have moved.
void CompoundPair::refresh(btManifoldResult& result) const {
  for (const PiecePair& pair : pieces_) {
    if (pair.may_touch && pair.manifold != nullptr && pair.manifold->getNumContacts() > 0) {
      result.setPersistentManifold(pair.manifold);
      result.refreshContactPoints();
    }
  }
  result.setPersistentManifold(nullptr);
}

void CompoundPair::descend(const btDbvtNode& first, const btDbvtNode& second, const Visit& visit) {
  const bool leaves = first.isleaf() && second.isleaf();
  if (leaves &&
      !overlap(visit.first.placed.pieces[first.dataAsInt].box, visit.second.placed.pieces[second.dataAsInt].box)) {
    return;
  }
  if (!visit.overlap(first.volume, second.volume)) return;
  if (leaves) {
    meet(first.dataAsInt, second.dataAsInt, visit);
  } else if (second.isleaf()) {
    descend(*first.childs[1], second, visit);
    descend(*first.childs[0], second, visit);
  } else if (first.isleaf()) {
    descend(first, *second.childs[1], visit);
    descend(first, *second.childs[0], visit);
  } else {
    descend(*first.childs[1], *second.childs[1], visit);
    descend(*first.childs[0], *second.childs[1], visit);
    descend(*first.childs[1], *second.childs[0], visit);
    descend(*first.childs[0], *second.childs[0], visit);
  }
}

void CompoundPair::meet(int first, int second, const Visit& visit) {
  const WorldPiece& a = visit.first.placed.pieces[first];
  const WorldPiece& b = visit.second.placed.pieces[second];
  const auto known = find(first, second);
  if (known != pieces_.end() && !known->may_touch && still_apart(*known, a, b)) return;
  const btCollisionObjectWrapper& whole_a = visit.first.whole;
  const btCollisionObjectWrapper& whole_b = visit.second.whole;
  const btCollisionObjectWrapper side_a(&whole_a, a.shape, whole_a.getCollisionObject(), a.place, -1, first);
  const btCollisionObjectWrapper side_b(&whole_b, b.shape, whole_b.getCollisionObject(), b.place, -1, second);
  PiecePair& pair = known != pieces_.end() ? *known : add(first, second, side_a, side_b);
  work(pair, side_a, side_b, visit);
}

/// Whether two pieces that do not touch are too far apart for points. First where they were apart last.
bool CompoundPair::still_apart(PiecePair& pair, const WorldPiece& a, const WorldPiece& b) {
  if (is_box(a) && is_box(b)) {
    if (pair.apart < 0 || !apart_along(pair.apart, box(a), a.place, box(b), b.place))
      pair.apart = separating_axis(box(a), a.place, box(b), b.place);
    return pair.apart >= 0;
  }
  if (pair.manifold == nullptr || polyhedron(a) == nullptr || polyhedron(b) == nullptr) return false;
  const PlacedPolyhedron first{polyhedron(a), a.place};
  const PlacedPolyhedron second{polyhedron(b), b.place};
  const btScalar gap = pair.manifold->getContactBreakingThreshold();
  if (pair.apart < 0 || !apart_along(pair.apart, first, second, gap)) pair.apart = separating_face(first, second, gap);
  return pair.apart >= 0;
}

void CompoundPair::work(PiecePair& pair, const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
                        const Visit& visit) {
  btManifoldResult& result = visit.result;
  const btCollisionObjectWrapper* whole_a = result.getBody0Wrap();
  const btCollisionObjectWrapper* whole_b = result.getBody1Wrap();
  result.setBody0Wrap(&a);
  result.setBody1Wrap(&b);
  result.setShapeIdentifiersA(-1, pair.first);
  result.setShapeIdentifiersB(-1, pair.second);
  pair.algorithm->processCollision(&a, &b, visit.info, &result);
  result.setBody0Wrap(whole_a);
  result.setBody1Wrap(whole_b);
  if (pair.manifold == nullptr) pair.manifold = manifold_of(*pair.algorithm);
  pair.may_touch = pair.manifold != nullptr && pair.manifold->getNumContacts() > 0;
}

// Two convex pieces have one manifold, from their first meeting or from their first point on.
btPersistentManifold* CompoundPair::manifold_of(btCollisionAlgorithm& algorithm) const {
  btManifoldArray& manifolds = maker_.manifolds;
  manifolds.resize(0);
  algorithm.getAllContactManifolds(manifolds);
  return manifolds.size() > 0 ? manifolds[0] : nullptr;
}

std::vector<CompoundPair::PiecePair>::iterator CompoundPair::find(int first, int second) {
  return std::ranges::find_if(
      pieces_, [first, second](const PiecePair& pair) { return pair.first == first && pair.second == second; });
}

CompoundPair::PiecePair& CompoundPair::add(int first, int second, const btCollisionObjectWrapper& a,
                                           const btCollisionObjectWrapper& b) {
  if (pieces_.empty()) pieces_.reserve(4);  // two pieces meet two
  btCollisionAlgorithm* algorithm = m_dispatcher->findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  pieces_.push_back({first, second, algorithm});
  return pieces_.back();
}

// Drops the pairs of pieces that no longer overlap: all of them first, then their places, each taken by the last.
void CompoundPair::part(const Side& first, const Side& second) {
  std::vector<std::pair<int, int>>& parted = maker_.parted;
  parted.clear();
  for (const PiecePair& pair : pieces_) {
    if (!overlap(first.placed.pieces[pair.first].box, second.placed.pieces[pair.second].box)) {
      destroy(pair.algorithm);
      parted.emplace_back(pair.first, pair.second);
    }
  }
  for (const auto& [a, b] : parted) {
    *find(a, b) = pieces_.back();
    pieces_.pop_back();
  }
}

}  // namespace talus::bullet

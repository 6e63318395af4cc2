#include "sim3d/bullet/compound_pair.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <LinearMath/btAabbUtil2.h>

#include <algorithm>

namespace talus::bullet {
namespace {

const btCompoundShape& compound(const btCollisionObjectWrapper& side) {
  return *static_cast<const btCompoundShape*>(side.getCollisionShape());
}

/// A piece where its body is.
struct PlacedChild {
  PlacedChild(const btCollisionObjectWrapper& side, int index)
      : shape(compound(side).getChildShape(index)),
        place(side.getWorldTransform() * compound(side).getChildTransform(index)) {
    shape->getAabb(place, low, high);
  }
  bool is_box() const { return shape->getShapeType() == BOX_SHAPE_PROXYTYPE; }
  bool overlaps(const PlacedChild& other) const { return TestAabbAgainstAabb2(low, high, other.low, other.high); }

  const btCollisionShape* shape;
  btTransform place;
  btVector3 low;
  btVector3 high;
};

const btBoxShape& box(const PlacedChild& child) { return *static_cast<const btBoxShape*>(child.shape); }

bool overlap(const btDbvtAabbMm& a, const btDbvtAabbMm& b, const btTransform& from_b_to_a) {
  btVector3 low;
  btVector3 high;
  btTransformAabb(b.Mins(), b.Maxs(), btScalar(0), from_b_to_a, low, high);
  return Intersect(a, btDbvtAabbMm::FromMM(low, high));
}

}  // namespace

struct CompoundPair::Visit {
  const btCollisionObjectWrapper& first;
  const btCollisionObjectWrapper& second;
  const btTransform second_in_first;
  const btDispatcherInfo& info;
  btManifoldResult& result;
};

btCollisionAlgorithm* CompoundPair::Maker::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                                    const btCollisionObjectWrapper*,
                                                                    const btCollisionObjectWrapper*) {
  return new (info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(CompoundPair)))
      CompoundPair(info.m_dispatcher1, *this);
}

CompoundPair::~CompoundPair() {
  for (const PiecePair& pair : pieces_) {
    destroy(pair.algorithm);
  }
}

void CompoundPair::destroy(btCollisionAlgorithm* algorithm) {
  algorithm->~btCollisionAlgorithm();
  m_dispatcher->freeCollisionAlgorithm(algorithm);
}

// Whoever asks may put points into them.
void CompoundPair::getAllContactManifolds(btManifoldArray& manifolds) {
  for (PiecePair& pair : pieces_) {
    pair.algorithm->getAllContactManifolds(manifolds);
    pair.may_touch = true;
  }
}

void CompoundPair::processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
                                    const btDispatcherInfo& info, btManifoldResult* result) {
  refresh(*result);
  const Visit visit{*first, *second, first->getWorldTransform().inverse() * second->getWorldTransform(), info, *result};
  descend(*compound(*first).getDynamicAabbTree()->m_root, *compound(*second).getDynamicAabbTree()->m_root, visit);
  part(visit);
}

// Follows the known points to where the bodies have moved.
void CompoundPair::refresh(btManifoldResult& result) {
  btManifoldArray& manifolds = maker_.manifolds;
  manifolds.resize(0);
  for (const PiecePair& pair : pieces_) {
    if (pair.may_touch) {
      pair.algorithm->getAllContactManifolds(manifolds);
    }
  }
  for (int i = 0; i < manifolds.size(); ++i) {
    if (manifolds[i]->getNumContacts() > 0) {
      result.setPersistentManifold(manifolds[i]);
      result.refreshContactPoints();
    }
  }
  result.setPersistentManifold(nullptr);
}

void CompoundPair::descend(const btDbvtNode& first, const btDbvtNode& second, const Visit& visit) {
  if (!overlap(first.volume, second.volume, visit.second_in_first)) {
    return;
  }
  if (first.isleaf() && second.isleaf()) {
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
  const PlacedChild a(visit.first, first);
  const PlacedChild b(visit.second, second);
  if (!a.overlaps(b)) {
    return;
  }
  const auto known = find(first, second);
  if (known != pieces_.end()) {
    known->overlaps = true;
    if (!known->may_touch && known->apart >= 0 && apart_along(known->apart, box(a), a.place, box(b), b.place)) {
      return;
    }
  }
  const btCollisionObjectWrapper side_a(&visit.first, a.shape, visit.first.getCollisionObject(), a.place, -1, first);
  const btCollisionObjectWrapper side_b(&visit.second, b.shape, visit.second.getCollisionObject(), b.place, -1, second);
  PiecePair& pair = known != pieces_.end() ? *known : add(first, second, side_a, side_b);
  btManifoldResult& result = visit.result;
  const btCollisionObjectWrapper* whole_a = result.getBody0Wrap();
  const btCollisionObjectWrapper* whole_b = result.getBody1Wrap();
  result.setBody0Wrap(&side_a);
  result.setBody1Wrap(&side_b);
  result.setShapeIdentifiersA(-1, first);
  result.setShapeIdentifiersB(-1, second);
  pair.algorithm->processCollision(&side_a, &side_b, visit.info, &result);
  pair.may_touch = touch(pair);
  const bool boxes = a.is_box() && b.is_box();
  pair.apart = boxes && !pair.may_touch ? separating_axis(box(a), a.place, box(b), b.place) : BoxAxis(-1);
  result.setBody0Wrap(whole_a);
  result.setBody1Wrap(whole_b);
}

bool CompoundPair::touch(const PiecePair& pair) {
  btManifoldArray& manifolds = maker_.manifolds;
  manifolds.resize(0);
  pair.algorithm->getAllContactManifolds(manifolds);
  for (int i = 0; i < manifolds.size(); ++i) {
    if (manifolds[i]->getNumContacts() > 0) {
      return true;
    }
  }
  return false;
}

std::vector<CompoundPair::PiecePair>::iterator CompoundPair::find(int first, int second) {
  return std::find_if(pieces_.begin(), pieces_.end(),
                      [first, second](const PiecePair& pair) { return pair.first == first && pair.second == second; });
}

CompoundPair::PiecePair& CompoundPair::add(int first, int second, const btCollisionObjectWrapper& a,
                                           const btCollisionObjectWrapper& b) {
  if (pieces_.empty()) {
    pieces_.reserve(4);  // two pieces meet two
  }
  btCollisionAlgorithm* algorithm = m_dispatcher->findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  pieces_.push_back({first, second, algorithm, true});
  return pieces_.back();
}

// Drops the pairs of pieces that no longer overlap: all of them first, then their places, each taken by the last.
void CompoundPair::part(const Visit& visit) {
  std::vector<std::pair<int, int>>& parted = maker_.parted;
  parted.clear();
  for (PiecePair& pair : pieces_) {
    if (!pair.overlaps && !PlacedChild(visit.first, pair.first).overlaps(PlacedChild(visit.second, pair.second))) {
      destroy(pair.algorithm);
      parted.emplace_back(pair.first, pair.second);
    }
    pair.overlaps = false;
  }
  for (const auto& [first, second] : parted) {
    *find(first, second) = pieces_.back();
    pieces_.pop_back();
  }
}

}  // namespace talus::bullet

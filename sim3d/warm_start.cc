#include "sim3d/warm_start.h"

#include <LinearMath/btAabbUtil2.h>

#include "sim3d/bullet/idle_pairs.h"
#include "sim3d/bullet/whole.h"

namespace talus::bullet {
namespace {

btCollisionObject& object_of(const btBroadphaseProxy* proxy) {
  return *static_cast<btCollisionObject*>(proxy->m_clientObject);
}

/// Records which manifold lies between which two pieces: Bullet gives this only while it processes a pair.
class PieceRecorder final : public btManifoldResult {
 public:
  using btManifoldResult::btManifoldResult;
  struct Entry {
    int piece0;
    int piece1;
    btPersistentManifold* manifold;
  };

  void setShapeIdentifiersA(int part, int piece) override {
    record();
    btManifoldResult::setShapeIdentifiersA(part, piece);
  }
  void setShapeIdentifiersB(int part, int piece) override {
    record();
    btManifoldResult::setShapeIdentifiersB(part, piece);
  }
  std::span<const Entry> finish() {
    record();
    return entries_;
  }

 private:
  void record() {
    btPersistentManifold* manifold = getPersistentManifold();
    if (manifold != nullptr && (entries_.empty() || entries_.back().manifold != manifold))
      entries_.push_back({m_index0, m_index1, manifold});
  }
  std::vector<Entry> entries_;
};

/// The nearest of the points without an impulse; -1: none. `first`: the owner is the manifold's first body.
int unloaded_near(const btVector3& on_owner, const btPersistentManifold& manifold, bool first) {
  int nearest = -1;
  btScalar least = BT_LARGE_FLOAT;
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    const btScalar apart = (first ? point.m_positionWorldOnA : point.m_positionWorldOnB).distance2(on_owner);
    if (point.m_appliedImpulse > 0 || apart >= least) continue;
    least = apart;
    nearest = i;
  }
  return nearest;
}

/// Whether a point, in the shape's axes, lies in the box around the shape, or outside by `margin` [m] at most. A body
/// that slides a little before each sleep may leave the face on which the point was.
bool holds(const btCollisionShape& shape, const btVector3& point, btScalar margin) {
  btVector3 low;
  btVector3 high;
  shape.getAabb(btTransform::getIdentity(), low, high);
  const btVector3 wide(margin, margin, margin);
  return TestPointAgainstAabb2(low - wide, high + wide, point);
}

/// The normal towards the owner, among the first `found` points, that is nearest to a kept one: both bodies may have
/// turned since, and the points of a face have one normal. `first`: the owner is the manifold's first body.
btVector3 normal_like(const btVector3& kept, const btPersistentManifold& manifold, int found, bool first) {
  btVector3 nearest = kept;
  btScalar most = 0;
  for (int i = 0; i < found; ++i) {
    const btVector3& on_second = manifold.getContactPoint(i).m_normalWorldOnB;
    const btVector3 normal = first ? on_second : -on_second;
    if (normal.dot(kept) <= most) continue;
    most = normal.dot(kept);
    nearest = normal;
  }
  return nearest;
}

}  // namespace

/// The two sides of a pair.
struct WarmStart::Sides {
  explicit Sides(const btBroadphasePair& pair)
      : owner(&object_of(pair.m_pProxy0)), partner(&object_of(pair.m_pProxy1)) {
    if (!owns(owner->getUserIndex(), partner->getUserIndex())) std::swap(owner, partner);
  }
  btCollisionObject* owner;
  btCollisionObject* partner;
};

void WarmStart::keep(const Sides& sides, const SavedPoint& point) {
  if (free_.empty()) {
    free_.push_back(static_cast<std::int32_t>(nodes_.size()));
    nodes_.emplace_back();
  }
  const std::int32_t node = free_.back();
  free_.pop_back();
  nodes_[node] = {point, -1};
  const BodyIndex owner = sides.owner->getUserIndex();
  if (std::ssize(first_) <= owner) first_.resize(owner + 1, -1);
  std::int32_t* link = &first_[owner];
  while (*link >= 0) link = &nodes_[*link].next;
  *link = node;
}

void WarmStart::release(BodyIndex owner, BodyIndex partner, std::vector<SavedPoint>& out) {
  if (std::ssize(first_) <= owner) return;
  for (std::int32_t* link = &first_[owner]; *link >= 0;) {
    const std::int32_t node = *link;
    const Node& here = nodes_[node];
    if (here.point.partner == partner) {
      out.push_back(here.point);
      *link = here.next;
      free_.push_back(node);
    } else {
      link = &nodes_[node].next;
    }
  }
}

void WarmStart::save(btBroadphasePair& pair) {
  if (pair.m_algorithm == nullptr) return;  // no step has passed since the pair came back: what was saved still holds
  const Sides sides(pair);
  // Points of an earlier sleep are replaced.
  release(sides.owner->getUserIndex(), sides.partner->getUserIndex(), saved_);
  saved_.clear();
  manifolds_.resize(0);
  pair.m_algorithm->getAllContactManifolds(manifolds_);
  for (int m = 0; m < manifolds_.size(); ++m) {
    const bool first = manifolds_[m]->getBody0() == sides.owner;
    for (int i = 0; i < manifolds_[m]->getNumContacts(); ++i) {
      const btManifoldPoint& point = manifolds_[m]->getContactPoint(i);
      if (point.m_appliedImpulse > 0) {
        const btVector3& place = first ? point.m_localPointA : point.m_localPointB;
        const btVector3 normal =
            (first ? point.m_normalWorldOnB : -point.m_normalWorldOnB) * sides.owner->getWorldTransform().getBasis();
        const btVector3 on_first = friction_impulse(point);
        const btVector3 friction = first ? on_first : -on_first;
        keep(sides, {sides.partner->getUserIndex(),
                     {place.x(), place.y(), place.z()},
                     {normal.x(), normal.y(), normal.z()},
                     point.m_distance1,
                     point.m_appliedImpulse,
                     {friction.x(), friction.y(), friction.z()},
                     static_cast<std::int16_t>(first ? point.m_index0 : point.m_index1),
                     static_cast<std::int16_t>(first ? point.m_index1 : point.m_index0),
                     is_unconfirmed(point),
                     PointMark()});
      }
    }
  }
}

/// In the plane several kept points lie behind each other and share the impulses of one.
void WarmStart::renew(const btCollisionObject& owner, std::span<const Renewed> points) {
  const BodyIndex body = owner.getUserIndex();
  if (std::ssize(first_) <= body) return;
  const auto nearest = [&](const SavedPoint& saved) {
    const btVector3 arm =
        owner.getWorldTransform().getBasis() * btVector3(saved.place[0], saved.place[1], saved.place[2]);
    std::size_t best = points.size();
    btScalar least = BT_LARGE_FLOAT;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const btScalar apart = (points[i].arm - arm).length2();
      if (points[i].partner != saved.partner || apart >= least) continue;
      least = apart;
      best = i;
    }
    return best;
  };
  std::vector<int> parts(points.size(), 0);
  for (std::int32_t node = first_[body]; node >= 0; node = nodes_[node].next)
    if (const std::size_t i = nearest(nodes_[node].point); i < points.size()) ++parts[i];
  for (std::int32_t node = first_[body]; node >= 0; node = nodes_[node].next) {
    SavedPoint& saved = nodes_[node].point;
    const std::size_t i = nearest(saved);
    if (i == points.size()) continue;
    const btScalar share = 1 / static_cast<btScalar>(parts[i]);
    saved.distance = points[i].distance;
    saved.impulse = share * points[i].impulse;
    saved.mark = points[i].mark;
    for (int k = 0; k < 3; ++k) saved.friction[k] = share * points[i].friction[k];
  }
}

void WarmStart::announce(btBroadphaseProxy& woken, const PairCache& pairs) {
  for (btBroadphaseProxy* partner : pairs.partners(&woken)) announced_.emplace_back(&woken, partner);
}

/// Points with a body that is removed stay with their owners: its number is never used again. An obstacle may come
/// back, at another place.
void WarmStart::forget(BodyIndex side) {
  if (side < 0) {
    for (BodyIndex owner = 0; owner < std::ssize(first_); ++owner) release(owner, side, saved_);
    saved_.clear();
  } else if (side < std::ssize(first_)) {
    std::int32_t& first = first_[side];
    while (first >= 0) {
      free_.push_back(first);
      first = nodes_[first].next;
    }
  }
  std::erase_if(announced_, [side](const auto& pair) {
    return object_of(pair.first).getUserIndex() == side || object_of(pair.second).getUserIndex() == side;
  });
}

void WarmStart::restore(PairCache& pairs, const btDispatcherInfo& info) {
  for (const auto& [a, b] : announced_) {
    btBroadphasePair* pair = pairs.findPair(a, b);
    if (pair != nullptr && pair->m_algorithm != nullptr) restore(*pair, info);
  }
  announced_.clear();
}

// Runs the pair's collision detection once more, at the same poses and so with the same points, to find which manifold
// belongs to which pieces.
void WarmStart::restore(btBroadphasePair& pair, const btDispatcherInfo& info) {
  const Sides sides(pair);
  saved_.clear();
  release(sides.owner->getUserIndex(), sides.partner->getUserIndex(), saved_);
  if (saved_.empty()) return;
  // In the order of the pair, for which the algorithm was made.
  const btCollisionObjectWrapper first = whole(object_of(pair.m_pProxy0));
  const btCollisionObjectWrapper second = whole(object_of(pair.m_pProxy1));
  const bool owner_first = &object_of(pair.m_pProxy0) == sides.owner;
  IdleMark::clear(pair);
  PieceRecorder recorder(&first, &second);
  open_manifolds(*pair.m_algorithm);
  pair.m_algorithm->processCollision(&first, &second, info, &recorder);
  for (const PieceRecorder::Entry& entry : recorder.finish()) {
    const int found = entry.manifold->getNumContacts();
    for (const SavedPoint& point : saved_) {
      // Bodies that move from sleep to sleep may lie apart by now.
      if (found == 0 && point.unconfirmed) continue;
      if (point.piece == (owner_first ? entry.piece0 : entry.piece1) &&
          point.partners_piece == (owner_first ? entry.piece1 : entry.piece0))
        put_back(point, sides, *entry.manifold, found);
    }
  }
  open_manifolds(*pair.m_algorithm);
}

// A pair that has given its manifolds away checks all of its pieces again (CompoundPair).
void WarmStart::open_manifolds(btCollisionAlgorithm& algorithm) {
  manifolds_.resize(0);
  algorithm.getAllContactManifolds(manifolds_);
}

void WarmStart::put_back(const SavedPoint& saved, const Sides& sides, btPersistentManifold& manifold, int found) {
  const btVector3 local(saved.place[0], saved.place[1], saved.place[2]);
  const bool first = manifold.getBody0() == sides.owner;
  btVector3 normal =
      sides.owner->getWorldTransform().getBasis() * btVector3(saved.normal[0], saved.normal[1], saved.normal[2]);
  if (saved.unconfirmed) normal = normal_like(normal, manifold, found, first);
  const btVector3 on_owner = sides.owner->getWorldTransform() * local;
  const btVector3 on_partner = on_owner - normal * saved.distance;
  const btVector3 partner_local = sides.partner->getWorldTransform().invXform(on_partner);
  const btScalar within = manifold.getContactBreakingThreshold() + btFabs(saved.distance);
  if (!holds(*sides.partner->getCollisionShape(), partner_local, within)) return;
  btManifoldPoint point(first ? local : partner_local, first ? partner_local : local, first ? normal : -normal,
                        saved.distance);
  point.m_positionWorldOnA = first ? on_owner : on_partner;
  point.m_positionWorldOnB = first ? on_partner : on_owner;
  point.m_combinedFriction = btManifoldResult::calculateCombinedFriction(sides.owner, sides.partner);
  point.m_combinedRestitution = btManifoldResult::calculateCombinedRestitution(sides.owner, sides.partner);
  point.m_index0 = first ? saved.piece : saved.partners_piece;
  point.m_index1 = first ? saved.partners_piece : saved.piece;
  int known = manifold.getCacheEntry(point);
  // Of a face's many corners Bullet keeps four, perhaps others than before.
  if (known < 0 && manifold.getNumContacts() == MANIFOLD_CACHE_SIZE) known = unloaded_near(on_owner, manifold, first);
  const bool added = known < 0;
  btManifoldPoint& target = manifold.getContactPoint(added ? manifold.addManifoldPoint(point) : known);
  target.m_appliedImpulse = saved.impulse;
  if (added) set_unconfirmed(target);
  if (saved.mark.step != 0) set_mark(target, {saved.mark.step, saved.mark.entry + (first ? 0 : 1)});
  const btVector3 friction(saved.friction[0], saved.friction[1], saved.friction[2]);
  set_friction_impulse(target, first ? friction : -friction);
}

}  // namespace talus::bullet

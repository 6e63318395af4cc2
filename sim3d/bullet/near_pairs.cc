#include "sim3d/bullet/near_pairs.h"

#include "sim3d/bullet/fetch.h"
#include "sim3d/bullet/idle_pairs.h"
#include "sim3d/bullet/whole.h"

namespace talus::bullet {
namespace {

const btCollisionObject& body_of(const btBroadphaseProxy* proxy) {
  return *static_cast<const btCollisionObject*>(proxy->m_clientObject);
}

}  // namespace

void NearPairs::collide(const btDispatcherInfo& info, std::span<btRigidBody* const> bodies, Team& team) {
  pairs_.places().start_step();
  btBroadphasePairArray& pairs = pairs_.getOverlappingPairArray();
  const bool share = team.size() > 1 && std::ssize(bodies) >= bodies_to_share;
  if (share) collide_steady(info, bodies, team);
  for (int i = 0; i < pairs.size(); ++i) {
    if (share && done_[i] != 0) continue;
    fetch_ahead(i, pairs.size());
    btBroadphasePair& pair = pairs[i];
    if (!IdleMark::is_set(pair) || !is_idle(pair)) visit(pair, info);
  }
}

void NearPairs::collide_steady(const btDispatcherInfo& info, std::span<btRigidBody* const> bodies, Team& team) {
  btBroadphasePairArray& pairs = pairs_.getOverlappingPairArray();
  team.divide(static_cast<int>(bodies.size()), [&](int first, int last, int /*member*/) {
    for (const btRigidBody* body : bodies.subspan(first, last - first))
      if (const std::int32_t slot = pairs_.list_of(*body); slot >= 0 && body->getCollisionShape()->isCompound())
        pairs_.places().of(slot, *body);
  });
  done_.assign(pairs.size(), 0);
  team.divide(pairs.size(), [&](int first, int last, int /*member*/) {
    for (int i = first; i < last; ++i) {
      fetch_ahead(i, last);
      done_[i] = visit_steady(pairs[i], info) ? 1 : 0;
    }
  });
}

const PlacedBody* NearPairs::known_place(const btCollisionObject& body) {
  const std::int32_t slot = pairs_.list_of(body);
  return slot >= 0 ? pairs_.places().known(slot) : pairs_.places().known_obstacle(body.getUserIndex());
}

/// Does the pair if that takes no memory that pairs share; returns whether it did.
bool NearPairs::visit_steady(btBroadphasePair& pair, const btDispatcherInfo& info) {
  if (IdleMark::is_set(pair)) {
    const IdleMark mark = IdleMark::of(pair);
    const PlacedBody* first = pairs_.places().known(mark.first);
    const PlacedBody* second = pairs_.places().known(mark.second);
    return first != nullptr && second != nullptr && !pieces_overlap(*first, *second);
  }
  if (!IdleMark::is_compound(pair)) return false;
  const btCollisionObject& first = body_of(pair.m_pProxy0);
  const btCollisionObject& second = body_of(pair.m_pProxy1);
  if (!first.isActive() && !second.isActive()) return true;
  const PlacedBody* first_placed = known_place(first);
  const PlacedBody* second_placed = known_place(second);
  if (first_placed == nullptr || second_placed == nullptr) return false;
  auto& algorithm = *static_cast<CompoundPair*>(pair.m_algorithm);
  if (algorithm.is_empty() || !algorithm.is_steady(*first_placed, *second_placed)) return false;
  const btCollisionObjectWrapper first_whole = whole(first);
  const btCollisionObjectWrapper second_whole = whole(second);
  btManifoldResult result(&first_whole, &second_whole);
  algorithm.follow({first_whole, *first_placed}, {second_whole, *second_placed}, info, result);
  return true;
}

// In four strides: the parts of a pair, then what only those lead to, down to the contact points. `last`: from there on
// another thread may write them.
void NearPairs::fetch_ahead(int i, int last) const {
  constexpr int stride = 4;
  const btBroadphasePairArray& pairs = const_cast<PairCache&>(pairs_).getOverlappingPairArray();
  if (i + 4 * stride >= last) return;
  const btBroadphasePair& far = pairs[i + 4 * stride];
  if (IdleMark::is_set(far)) {
    const IdleMark mark = IdleMark::of(far);
    const_cast<PairCache&>(pairs_).places().fetch(mark.first);
    const_cast<PairCache&>(pairs_).places().fetch(mark.second);
  } else {
    __builtin_prefetch(far.m_algorithm);
    __builtin_prefetch(far.m_pProxy0);
    __builtin_prefetch(far.m_pProxy1);
  }
  if (const btBroadphasePair& nearer = pairs[i + 3 * stride]; !IdleMark::is_set(nearer)) {
    fetch(body_of(nearer.m_pProxy0));
    fetch(body_of(nearer.m_pProxy1));
  }
  if (const btBroadphasePair& near = pairs[i + 2 * stride]; IdleMark::is_compound(near) && near.m_algorithm != nullptr)
    static_cast<const CompoundPair*>(near.m_algorithm)->fetch();
  if (const btBroadphasePair& next = pairs[i + stride]; IdleMark::is_compound(next) && next.m_algorithm != nullptr)
    static_cast<const CompoundPair*>(next.m_algorithm)->fetch_points();
}

bool NearPairs::is_idle(const btBroadphasePair& pair) {
  const IdleMark mark = IdleMark::of(pair);
  PlacedPieces& places = pairs_.places();
  const PlacedBody* first = places.known(mark.first);
  const PlacedBody* second = places.known(mark.second);
  if (first == nullptr) first = &places.of(mark.first, body_of(pair.m_pProxy0));
  if (second == nullptr) second = &places.of(mark.second, body_of(pair.m_pProxy1));
  return !pieces_overlap(*first, *second);
}

void NearPairs::visit(btBroadphasePair& pair, const btDispatcherInfo& info) {
  const btCollisionObject& first = body_of(pair.m_pProxy0);
  const btCollisionObject& second = body_of(pair.m_pProxy1);
  if (!IdleMark::is_compound(pair) && !IdleMark::is_set(pair) &&
      (!first.getCollisionShape()->isCompound() || !second.getCollisionShape()->isCompound())) {
    dispatcher_.getNearCallback()(pair, dispatcher_, info);
  } else if ((first.isActive() || second.isActive()) && first.checkCollideWith(&second) &&
             second.checkCollideWith(&first)) {
    meet(pair, first, second, info);
  }
}

void NearPairs::meet(btBroadphasePair& pair, const btCollisionObject& first, const btCollisionObject& second,
                     const btDispatcherInfo& info) {
  const btCollisionObjectWrapper first_whole = whole(first);
  const btCollisionObjectWrapper second_whole = whole(second);
  if (pair.m_algorithm == nullptr)
    pair.m_algorithm = dispatcher_.findAlgorithm(&first_whole, &second_whole, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  auto& algorithm = *static_cast<CompoundPair*>(pair.m_algorithm);
  const IdleMark slots{pairs_.list_of(first), pairs_.list_of(second)};
  const PlacedBody& first_placed = pairs_.places().of(slots.first, first);
  const PlacedBody& second_placed = pairs_.places().of(slots.second, second);
  btManifoldResult result(&first_whole, &second_whole);
  algorithm.collide({first_whole, first_placed}, {second_whole, second_placed}, info, result);
  if (skip_idle_ && algorithm.is_empty() && slots.first >= 0 && slots.second >= 0)
    slots.set(pair);
  else
    IdleMark::set_compound(pair);
}

}  // namespace talus::bullet

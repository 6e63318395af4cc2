#pragma once
// Contacts between two bodies of several pieces.

#include <btBulletCollisionCommon.h>

#include <utility>
#include <vector>

#include "sim3d/bullet/placed_pieces.h"
#include "sim3d/bullet/separation.h"

namespace talus::bullet {

/// Replaces btCompoundCompoundCollisionAlgorithm, to the bit. There each call places each pair of pieces again, builds
/// and drops four contact manifolds on the stack, and each new pair allocates ten times. Here pieces are placed
/// once a step (placed_pieces.h); where no boxes of pieces overlap, the trees of pieces are not walked; two boxes or
/// polyhedra that do not touch and are apart (separation.h) are left alone, and with them the memory of their algorithm
/// and Bullet's search for their closest points; the manifold of two pieces is kept beside them. The order in which
/// pieces meet, come and go is Bullet's, since it decides the order in which the solver takes the contacts.
class CompoundPair final : public btCollisionAlgorithm {
 public:
  struct Maker;
  CompoundPair(btDispatcher* dispatcher, Maker& maker) : maker_(maker) { m_dispatcher = dispatcher; }
  CompoundPair(const CompoundPair&) = delete;
  CompoundPair& operator=(const CompoundPair&) = delete;
  ~CompoundPair() override;

  /// One of the two bodies.
  struct Side {
    const btCollisionObjectWrapper& whole;
    const PlacedBody& placed;
  };
  void collide(const Side& first, const Side& second, const btDispatcherInfo& info, btManifoldResult& result);

  /// Whether its pieces meet as they did: collide() would make and drop nothing.
  bool is_steady(const PlacedBody& first, const PlacedBody& second) const;
  /// collide() of a pair that is steady. Touches no memory of other pairs.
  void follow(const Side& first, const Side& second, const btDispatcherInfo& info, btManifoldResult& result);

  /// Whether no two pieces are near each other: nothing to follow.
  bool is_empty() const { return pieces_.empty(); }

  /// Fetches what collide() will read first.
  void fetch() const {
    for (std::size_t i = 0; i < pieces_.size(); ++i) __builtin_prefetch(pieces_.data() + i);
  }
  void fetch_points() const;

  void processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
                        const btDispatcherInfo& info, btManifoldResult* result) override;
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;  // as all of Bullet's: nothing uses it
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override;
  /// Appends the manifolds that may have points, for reading.
  void append_touching(btManifoldArray& manifolds) const {
    for (const PiecePair& pair : pieces_)
      if (pair.may_touch && pair.manifold != nullptr) manifolds.push_back(pair.manifold);
  }

  /// What Bullet's dispatcher calls for a new pair.
  struct Maker final : btCollisionAlgorithmCreateFunc {
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* first,
                                                   const btCollisionObjectWrapper* second) override;
    btManifoldArray manifolds;  // scratch of all pairs
    std::vector<std::pair<int, int>> parted;
    PlacedBody first;
    PlacedBody second;
  };

 private:
  /// Two pieces whose bounding boxes overlap.
  struct PiecePair {
    int first = 0;
    int second = 0;
    btCollisionAlgorithm* algorithm = nullptr;
    btPersistentManifold* manifold = nullptr;  // the algorithm's; null before its first point
    bool may_touch = true;                     // false: its manifold is known to be empty, and need not be checked
    FaceAxis apart = -1;                       // where two boxes (BoxAxis) or two polyhedra were apart last
  };
  struct Visit;

  void refresh(btManifoldResult& result) const;
  void descend(const btDbvtNode& first, const btDbvtNode& second, const Visit& visit);
  void meet(int first, int second, const Visit& visit);
  static bool still_apart(PiecePair& pair, const WorldPiece& a, const WorldPiece& b);
  void work(PiecePair& pair, const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, const Visit& visit);
  PiecePair& add(int first, int second, const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b);
  std::vector<PiecePair>::iterator find(int first, int second);
  btPersistentManifold* manifold_of(btCollisionAlgorithm& algorithm) const;
  void part(const Side& first, const Side& second);
  void destroy(btCollisionAlgorithm* algorithm);

  Maker& maker_;
  std::vector<PiecePair> pieces_;
};

}  // namespace talus::bullet

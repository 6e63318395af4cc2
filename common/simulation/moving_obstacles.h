#pragma once

#include <vector>

#include "common/scene/scene.h"
#include "common/shape/convex_piece.h"
#include "common/world/world.h"

namespace talus {

/// Moves the obstacles of a scene that have a plan, and finds the bodies that touch them: a sleeping body would neither
/// follow nor be pushed.
template <int Dim>
class MovingObstacles {
 public:
  explicit MovingObstacles(const Scene<Dim>& scene);

  /// Before a step from `time` [s] on: moves the obstacles. Returns the sleeping bodies that touch one that moves, or
  /// will within the step, without feeling its force; valid until the next call.
  const std::vector<BodyIndex>& move(World<Dim>& world, double time);

  /// Whether any moved in the last call of move().
  bool any_moved() const { return !moving_.empty(); }

  /// Whether a body touches an obstacle that moved in the last step and that it would not follow in its sleep.
  bool keep_awake(const World<Dim>& world, BodyIndex body) const;

  /// Where the plan has an obstacle at a time [s].
  Pose<Dim> pose_at(const World<Dim>& world, int obstacle, double time) const;

  bool moves_after(const World<Dim>& world, double time) const;

 private:
  struct Piece {
    int obstacle = 0;        // number
    bool belt = false;       // its surface moves, which sleeping bodies do not feel
    ConvexPiece<Dim> piece;  // in the world's axes, after the step
    Box<Dim> bounds;         // of it before and after
    double travel = 0.0;     // of its fastest point [m]
  };
  void move(World<Dim>& world, const Mover<Dim>& mover, int obstacle, double time);
  void find_sleepers(const World<Dim>& world, const Piece& piece);
  bool touches(const World<Dim>& world, const Piece& piece, BodyIndex body) const;

  std::vector<Mover<Dim>> movers_;
  std::vector<Obstacle<Dim>> obstacles_;               // of the world, before they moved
  std::vector<std::vector<ConvexPiece<Dim>>> bodies_;  // by shape, in their own axes
  std::vector<std::vector<ConvexPiece<Dim>>> pieces_;  // of movers' obstacles, by number, in their own axes
  std::vector<Piece> moving_;                          // in this step
  std::vector<BodyIndex> touched_;
  std::vector<BodyIndex> near_;  // scratch
  double margin_ = 0.0;          // distance up to which a body counts as touching [m]
  double dt_;
};

}  // namespace talus

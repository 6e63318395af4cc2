#pragma once
// Bodies that the program moves, whatever they meet.

#include <vector>

#include "common/sleeper/given_world.h"

namespace talus {

/// Kinematic bodies and their motion in the last step. Each is an obstacle of the world. The engine neither carries nor
/// pushes a sleeping body with one.
template <int Dim>
class KinematicBodies {
 public:
  /// `world` must outlive this object.
  explicit KinematicBodies(GivenWorld<Dim>& world) : world_(world) {}

  /// Returns its number among the obstacles, which may be that of a removed one.
  int add(const Shape<Dim>& shape, const Pose<Dim>& pose);
  void remove(int number) { world_.remove_obstacle(number); }

  Box<Dim> bounds(int number) const { return bounds_at(world_.obstacle_shape(number), world_.obstacle_pose(number)); }

  /// The program has put it elsewhere.
  void place(int number, const Pose<Dim>& at);
  /// After a step of `dt` [s]: where it is and how fast. It counts as moving if it goes by more than rounding, for
  /// sleeping bodies of `extent` [m], or has crept away since it last did.
  void move(int number, const Pose<Dim>& to, const Vec<Dim>& velocity, const Spin<Dim>& spin, double dt, double extent);
  bool moved(int number) const { return bodies_[number].moved; }
  /// Appends the sleeping bodies that the kinematic body touches or may touch within the next step; none if it did not
  /// move.
  void find_sleepers(int number, double margin, std::vector<BodyIndex>& found) const;

 private:
  struct Body {
    Pose<Dim> noticed;  // where it last counted as moving
    bool moved = false;
    double travel = 0.0;  // of its fastest point within a step [m]
  };
  GivenWorld<Dim>& world_;
  std::vector<Body> bodies_;  // [number]; those of other obstacles mean nothing
};

}  // namespace talus

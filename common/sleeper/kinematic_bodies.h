#pragma once
// Bodies that the program moves, whatever they meet.

#include <vector>

#include "common/shape/convex_piece.h"
#include "common/world/world.h"

namespace talus {

/// Kinematic bodies and their motion in the last step. A sleeping body would neither follow nor be pushed by one.
template <int Dim>
class KinematicBodies {
 public:
  /// Returns the number of the body, which may be that of a removed one.
  int add(const Shape<Dim>& shape, const Pose<Dim>& pose);
  void remove(int number) { free_.push_back(number); }

  const Pose<Dim>& pose(int number) const { return bodies_[number].pose; }
  Box<Dim> bounds(int number) const;

  /// The program has put it elsewhere.
  void place(int number, const Pose<Dim>& at) { bodies_[number].pose = bodies_[number].noticed = at; }
  /// After a step of `dt` [s]: where it is and how fast. It counts as moving if it goes by more than rounding, for
  /// sleeping bodies of `extent` [m], or has crept away since it last did.
  void move(int number, const Pose<Dim>& to, const Vec<Dim>& velocity, const Spin<Dim>& spin, double dt, double extent);
  bool moved(int number) const { return bodies_[number].moved; }
  /// Appends the sleeping bodies that the kinematic body touches or may touch within the next step; none if it did not
  /// move.
  void find_sleepers(int number, const World<Dim>& world, double margin, std::vector<BodyIndex>& found) const;

 private:
  struct Body {
    Shape<Dim> shape;
    Pose<Dim> pose;
    Pose<Dim> noticed;  // where it last counted as moving
    bool moved = false;
    double travel = 0.0;  // of its fastest point within a step [m]
  };
  std::vector<Body> bodies_;
  std::vector<int> free_;
};

}  // namespace talus

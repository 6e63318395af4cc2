#pragma once
// How an obstacle moves by plan, or gravity changes.

#include <optional>
#include <vector>

#include "common/math/vector.h"
#include "common/world/world_description.h"

namespace talus {

/// A motion as a function of time alone: a shift and a turn about a pivot, both 0 for an obstacle in its place. A
/// sine, a constant turn and a path of straight pieces; their sum where several are given. Or a belt: the obstacle
/// stays and its surface moves along itself.
template <int Dim>
struct Motion {
  Vec<Dim> amplitude = Vec<Dim>::Zero();  // of the sine [m]
  double frequency = 0.0;                 // [1/s]
  double speed = 0.0;                     // of the turn [rad/s]
  Vec<Dim> belt = Vec<Dim>::Zero();       // velocity of the surface [m/s]
  double start = 0.0;                     // of sine, turn and belt [s]
  std::optional<double> end = {};         // of sine, turn and belt [s]; the obstacle stays where it is then
  std::vector<double> times = {};         // of the path's corners [s], ascending
  std::vector<Vec<Dim>> shifts = {};      // there [m]
  std::vector<double> angles = {};        // there [rad]; empty: no turn
  Vec3 axis = Vec3::UnitY();              // of turns, unit; means nothing in 2D

  Vec<Dim> shift_at(double time) const;
  double angle_at(double time) const;
  Rotation<Dim> turn_at(double time) const;
  /// Velocity of the surface [m/s].
  Vec<Dim> belt_at(double time) const;
  /// Whether it may move after this time [s].
  bool moves_after(double time) const;
  /// Upper bounds of the speed of the pivot [m/s] and of the turn [rad/s].
  double fastest_shift() const;
  double fastest_turn() const;
};

/// Obstacles of a world that move as one: from number `first` on, `count` of them.
template <int Dim>
struct Mover {
  int first = 0;
  int count = 0;
  Vec<Dim> pivot = Vec<Dim>::Zero();
  Motion<Dim> motion;

  /// Where an obstacle is that was at `initial` before it moved.
  Pose<Dim> pose_at(double time, const Pose<Dim>& initial) const;
};

/// Where an obstacle is.
template <int Dim>
struct ObstaclePose {
  int obstacle = 0;  // in WorldDescription::obstacles
  Pose<Dim> pose;
};

/// The obstacles as they are at a time [s].
template <int Dim>
std::vector<Obstacle<Dim>> obstacles_at(std::vector<Obstacle<Dim>> obstacles, const std::vector<Mover<Dim>>& movers,
                                        double time);

}  // namespace talus

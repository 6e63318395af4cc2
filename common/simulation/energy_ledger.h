#pragma once

#include <algorithm>
#include <vector>

#include "common/world/world.h"

namespace talus {

/// Keeps account of the energy that an engine creates within its steps. Costs O(awake) a step, and O(contacts) while
/// an obstacle moves.
///
/// A step of a rigid-body engine may lose energy (friction, impact) but gets it from gravity, pushes and obstacles that
/// move alone. What happens between steps (sources, sleep, kicks, a change of gravity) is not the engine's and does
/// not count. Each sum below never falls below 0, so it is the rise over the lowest value so far: an early loss does
/// not hide a late gain.
template <int Dim>
class EnergyLedger {
 public:
  explicit EnergyLedger(const WorldDescription<Dim>& world);

  /// Just before World::step(), once all that acts in the step is set. The step must record contacts if an obstacle
  /// moves in it.
  void start_step(const World<Dim>& world);
  /// Just after it.
  void end_step(const World<Dim>& world);

  /// Kinetic and potential energy that the steps created and have not lost since [J].
  double rise() const { return rise_; }

  /// What rounding, time steps and position correction may create [J]: a tenth of the largest kinetic energy so far
  /// and of the work that lifts each awake body by its own extent, at most so far: Box2D lifts a stack of touching
  /// bodies, which may fall asleep before the sum is checked.
  double tolerance() const;

  /// Kinetic energy that contacts created and have not dissipated since [J]: what the velocities of a step show beyond
  /// those before it and gravity's part. Position correction and the error of the time step have no part in it.
  double burst() const { return burst_; }

  /// Energy created beyond what is tolerated: the larger of rise() and burst() that is above its tolerance, else 0 [J].
  double created() const {
    return std::max(rise_ > tolerance() ? rise_ : 0.0, burst_ > burst_tolerance() ? burst_ : 0.0);
  }

  /// What contacts may create of it by correcting overlap with velocity, as Bullet does [J].
  double burst_tolerance() const;

  /// Work of the obstacles that moved, on bodies, in the last step [J]: the impulse of each contact point times the
  /// obstacle's motion there.
  double work() const { return work_; }

 private:
  struct Before {
    BodyIndex body = 0;
    Vec<Dim> position = Vec<Dim>::Zero();
    Vec<Dim> velocity = Vec<Dim>::Zero();
    double kinetic = 0.0;                      // [J]
    Vec<Dim> acceleration = Vec<Dim>::Zero();  // by gravity and pushes in the step [m/s^2]
  };
  struct ObstacleBefore {
    int number = 0;
    Pose<Dim> pose;
  };
  void add(const World<Dim>& world, const Before& before);
  double work_of_obstacles(const World<Dim>& world);
  double work_of(const World<Dim>& world, const Contact<Dim>& contact) const;

  double dt_;                              // [s]
  std::vector<Before> before_;             // awake bodies before the step, ascending
  std::vector<ObstacleBefore> obstacles_;  // those that may move, before the step
  std::vector<Contact<Dim>> sleeping_;     // scratch
  double change_ = 0.0;                    // of kinetic and potential energy in this step [J]
  double gain_ = 0.0;                      // of kinetic energy in this step beyond what gravity gives a free body [J]
  double work_ = 0.0;                      // [J]
  double held_ = 0.0;                      // what contacts that an obstacle squeezed may give back to it in the next
                                           // step: its work in this one, if positive [J]
  double kinetic_ = 0.0;                   // of the awake bodies after this step [J]
  double lift_ = 0.0;             // work that lifts each awake body of this step by its extent, and gives it a motion
                                  // too slow to be seen [J]
  double largest_kinetic_ = 0.0;  // so far [J]
  double largest_lift_ = 0.0;     // so far [J]
  double burst_lift_ = 0.0;       // largest since burst_ was last 0 [J]
  double rise_ = 0.0;             // [J]
  double burst_ = 0.0;            // [J]
};

}  // namespace talus

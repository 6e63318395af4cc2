#pragma once

#include <vector>

#include "common/world/world.h"

namespace talus {

/// Keeps account of the kinetic and potential energy of all bodies and of what was put in, so that energy which the
/// engine creates shows. Costs O(awake) a step and eight bytes a body.
///
/// A step of a rigid-body engine may lose energy (friction, impact, freezing) but must not create any. The ledger sums
/// the changes that no source and no policy made. The sum never falls below 0, so it is the rise over the lowest
/// energy so far: an early loss does not hide a late gain. Energies are relative to the origin, which cancels out in
/// every change.
template <int Dim>
class EnergyLedger {
 public:
  explicit EnergyLedger(const WorldDescription<Dim>& world);

  /// Bodies that were added since the last call, at the energy that they have now.
  void note_added(const World<Dim>& world);

  /// A body will get a new velocity from outside the engine.
  void note_velocity(const World<Dim>& world, BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin);

  /// The state of a body after a step. To be called for each body that is awake or fell asleep in the step.
  void note_state(const World<Dim>& world, BodyIndex body);

  /// After note_state() of all these bodies.
  void close_step();

  /// Energy that the engine created and has not lost since [J].
  double rise() const { return rise_; }

  /// What rounding, time steps and position correction may create [J]: a tenth of the largest kinetic energy so far
  /// and of the work that lifts each awake body by its own extent, at most so far: Box2D lifts a stack of touching
  /// bodies, which may fall asleep before the sum is checked.
  double tolerance() const;

 private:
  double energy(const World<Dim>& world, BodyIndex body, double kinetic) const;

  /// Of one shape.
  struct Constants {
    double weight = 0.0;  // [N]
    double scale = 0.0;   // work to lift it by its extent, and a motion too slow to be seen [J]
  };
  const Constants& constants_of(const World<Dim>& world, BodyIndex body) const {
    return constants_[world.states().shape[body]];
  }

  Vec<Dim> down_;
  std::vector<Constants> constants_;  // by shape
  std::vector<double> last_;          // energy of each body when last noted [J]
  double change_ = 0.0;               // in this step [J], without what was put in
  double kinetic_ = 0.0;              // of the bodies noted in this step [J]
  double scale_ = 0.0;                // of the bodies noted in this step [J]
  double largest_kinetic_ = 0.0;      // so far [J]
  double largest_scale_ = 0.0;        // so far [J]
  double rise_ = 0.0;                 // [J]
};

}  // namespace talus

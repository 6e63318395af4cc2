#pragma once
// Where bodies are when their contacts are detected.

#include <algorithm>
#include <vector>

#include "common/solver/solver_body.h"
#include "common/world/world_description.h"

namespace talus {

/// The displacement of each body and obstacle before its contacts are detected, from FastBodies::drift(). The solver
/// keeps normals and arms of contacts through a step; those of its start would add energy to bodies that rock. So
/// contacts are detected in the middle of the step (leapfrog). Zero between two steps.
template <int Dim>
class Drift {
 public:
  explicit Drift(const WorldDescription<Dim>& description)
      : of_slots_(1), of_obstacles_(description.obstacles.size()) {}

  /// Of the awake bodies in the order of their slots.
  void add(const StepMotion<Dim>& motion) { of_slots_.push_back(motion); }
  const StepMotion<Dim>& last() const { return of_slots_.back(); }
  /// By the obstacle's number.
  void set(int number, const StepMotion<Dim>& motion) { of_obstacles_[number] = motion; }

  /// `slot`: of the owner, if it is a body.
  StepMotion<Dim> of(BodyIndex owner, int slot) const {
    if (owner <= first_obstacle) return of_obstacles_[first_obstacle - owner];
    return owner >= 0 && slot > 0 && slot < std::ssize(of_slots_) ? of_slots_[slot] : StepMotion<Dim>{};
  }

  void end() {
    of_slots_.resize(1);
    std::ranges::fill(of_obstacles_, StepMotion<Dim>{});
  }

 private:
  std::vector<StepMotion<Dim>> of_slots_;      // from 1 on
  std::vector<StepMotion<Dim>> of_obstacles_;  // by number
};

}  // namespace talus

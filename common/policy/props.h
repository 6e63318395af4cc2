#pragma once
// Sleepers whose support moves away.

#include <span>
#include <vector>

#include "common/world/world.h"

namespace talus {

/// Remembers for each awake body which sleepers rest on it or lean against it, and where they touched first. A sleeper
/// presses on nobody, so the forces of the engine cannot tell that its support leaves; the way the support went can.
template <int Dim>
class Props {
 public:
  /// `slack` [m] > 0: how far the place of contact may go before the sleeper counts as left alone.
  explicit Props(double slack) : slack_(slack) {}

  /// Appends sleepers that lost a support, each once, ascending. To be called once a step; costs O(contacts).
  void update(std::span<const Contact<Dim>> contacts, const BodyStates<Dim>& states, std::vector<BodyIndex>& left);

 private:
  struct Prop {
    BodyIndex bearer = 0;
    BodyIndex borne = 0;
    Vec<Dim> place = Vec<Dim>::Zero();  // of the contact when it was first seen [m]
    Vec<Dim> local = Vec<Dim>::Zero();  // the same in the bearer's own axes
  };

  void forget_settled(const BodyStates<Dim>& states);
  void remember(std::span<const Contact<Dim>> contacts, const BodyStates<Dim>& states);

  double slack_;
  std::vector<Prop> props_;  // ascending by bearer, then borne
  std::vector<Prop> fresh_;  // scratch
};

}  // namespace talus

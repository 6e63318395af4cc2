#pragma once

#include <cstdint>
#include <vector>

#include "common/policy/observer.h"
#include "common/world/body.h"

namespace talus {

/// A point of contact with its forces.
template <int Dim>
struct ShownContact {
  BodyIndex a = 0;
  BodyIndex b = ground_index;                  // as in Contact
  Vec<Dim> point = Vec<Dim>::Zero();           // [m]
  Vec<Dim> normal_force = Vec<Dim>::Zero();    // on a [N], mean over the step
  Vec<Dim> friction_force = Vec<Dim>::Zero();  // on a [N], mean over the step
  bool kept = false;                           // of bodies that sleep: as it was in the last step before
};

/// Contacts to show, while they are wanted: of awake bodies those of the last step; between sleeping bodies, of which
/// engines compute none, those of the last step before both slept.
template <int Dim>
class ContactMemory final : public Observer<Dim> {
 public:
  /// `dt`: length of a step [s].
  explicit ContactMemory(double dt) : dt_(dt) {}

  /// While false, steps do not record contacts for this, and nothing is kept. `world`: after its last step, whose
  /// contacts count if it recorded any.
  void want(bool wanted, const World<Dim>& world);

  bool needs_contacts() const override { return wanted_; }
  void on_frame(const Frame<Dim>& frame) override;

  std::vector<ShownContact<Dim>> contacts(const World<Dim>& world) const;

 private:
  double dt_;
  bool wanted_ = false;
  std::vector<Contact<Dim>> last_;   // of the last step
  std::vector<Contact<Dim>> kept_;   // of steps before, between bodies that sleep since
  std::vector<std::uint8_t> moved_;  // scratch: by body, whether it fell asleep or woke in the step
};

}  // namespace talus

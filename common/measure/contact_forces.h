#pragma once
// The forces in the contacts of all bodies, awake or asleep.

#include <cstdint>
#include <vector>

#include "common/policy/observer.h"
#include "common/world/body.h"

namespace talus {

/// The contact points with a force, while they are recorded: of awake bodies those of the last step; between sleeping
/// bodies, of which engines compute none, those that a ring keeps (World::set_ring()), else as they were in the last
/// step before both slept. Of bodies that slept before that, as at the start, none are known.
template <int Dim>
class ContactForces final : public Observer<Dim> {
 public:
  /// While false, steps do not record contacts for this, and nothing is kept. `world`: after its last step; the
  /// contacts of that step count if it recorded any.
  void record(bool on, const World<Dim>& world);

  bool needs_contacts() const override { return on_; }
  void on_frame(const Frame<Dim>& frame) override;

  /// Of the last step; none while they are not recorded.
  std::vector<ContactForce<Dim>> of(const World<Dim>& world) const;

 private:
  bool on_ = false;
  std::vector<Contact<Dim>> last_;   // of the last step
  std::vector<Contact<Dim>> kept_;   // of steps before, between bodies that sleep since
  std::vector<std::uint8_t> moved_;  // scratch: by body, whether it fell asleep or woke in the step
};

}  // namespace talus

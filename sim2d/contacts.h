#pragma once
// Engine contacts as ours.

#include <box2d/box2d.h>

#include <vector>

#include "common/world/body.h"
#include "common/world/world_description.h"
#include "sim2d/contact_records.h"
#include "sim2d/continuous.h"
#include "sim2d/warm_start.h"

namespace talus::box2d {

/// Listens to Box2D within a step: mixes restitutions, warm-starts contacts that freezing or thawing made anew, spares
/// slow bodies continuous collision against sleepers, and, once contacts are asked for, notes what only a listener
/// sees: speeds before the solver, and the impulses of impacts that continuous collision finds after it.
class ContactListener final : public b2ContactListener {
 public:
  ContactListener(const WorldDescription<2>& description, const WarmStart& warm_start);

  void BeginContact(b2Contact* contact) override;
  void PreSolve(b2Contact* contact, const b2Manifold* before) override;
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

  /// Forgets the last step. `sleepers`: whether there are any in the coming one; `recording`: whether to note it.
  void start_step(bool sleepers, bool recording);

  /// Appends a body's touching contacts by their other side. Every contact comes once: that of two awake bodies with
  /// the one of lower index. Without a record of the step, approach speeds are 0.
  void gather(b2Body& body, BodyIndex index, std::vector<Contact<2>>& out);

 private:
  void append(b2Contact& contact, BodyIndex a, std::vector<Contact<2>>& out) const;

  const WarmStart* warm_start_;
  ContinuousCollision continuous_;
  bool mix_restitutions_;
  bool sleepers_ = false;
  bool recording_ = false;
  ContactRecords records_;
  std::vector<b2Contact*> touching_;  // scratch
};

}  // namespace talus::box2d

#pragma once
// Box2D's contacts as ours.

#include <box2d/box2d.h>

#include <cstdint>
#include <span>
#include <vector>

#include "common/world/body.h"
#include "sim2d/contact_records.h"
#include "sim2d/continuous.h"
#include "sim2d/warm_start.h"

namespace talus::box2d {

/// Listens to Box2D within a step: mixes restitutions, warm-starts contacts that freezing or thawing made again, passes
/// solved contacts to ContinuousCollision, and, in a step that records contacts, notes what only a listener
/// gets: speeds before the solver, and the impulses of impacts that continuous collision finds after it.
class ContactListener final : public b2ContactListener {
 public:
  ContactListener(const WarmStart& warm_start, ContinuousCollision& continuous)
      : warm_start_(&warm_start), continuous_(&continuous) {}

  void BeginContact(b2Contact* contact) override;
  void PreSolve(b2Contact* contact, const b2Manifold* before) override;
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

  /// Forgets the last step. `sleepers`: whether there are frozen bodies in the coming one and slow bodies are not swept
  /// against them; `recording`: whether to record its contacts.
  void start_step(bool sleepers, bool recording);

  /// After a step that recorded: appends its touching contacts, sorted by their bodies and pieces. Each is listed once:
  /// that of two awake bodies under the one with the lower index. `asleep`: by body.
  void gather(std::span<const std::uint8_t> asleep, std::vector<Contact<2>>& out) const;

 private:
  /// A contact, and its two sides in the order of the result.
  struct Touch {
    Tag a;
    Tag b;
    const ContactRecord* record;
  };
  static void append(const Touch& touch, std::vector<Contact<2>>& out);

  const WarmStart* warm_start_;
  ContinuousCollision* continuous_;
  bool sleepers_ = false;
  bool recording_ = false;
  ContactRecords records_;
  mutable std::vector<Touch> touches_;  // scratch
};

}  // namespace talus::box2d

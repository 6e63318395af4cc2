#pragma once
// Sleep by contact. The paper's layers set how long a body must have been at rest; its contacts decide whether it may
// sleep.

#include <optional>
#include <vector>

#include "common/policy/adaptive/support_criterion.h"
#include "common/policy/rest/adaptive_params.h"
#include "common/policy/rest/rest_criterion.h"
#include "common/policy/sleep_policy.h"
#include "common/policy/wake_rules/wake_rules.h"

namespace talus {

/// Each body sleeps by itself, once it has been at rest for a while and is supported by ground, sleeping bodies or
/// bodies that fall asleep with it. The time depends on its pile's density and on its closeness to the centre (section
/// 3.3), and is short for a body that woke and did not move. A body wakes when the contact solve moves it, and without
/// a ring by the WakeRules.
template <int Dim>
class AdaptivePolicy final : public SleepPolicy<Dim> {
 public:
  /// `typical` gives D and the mass of a body.
  AdaptivePolicy(const AdaptiveParams& params, const WorldDescription<Dim>& world, const TypicalBody& typical);

  bool counts_flying() const override { return false; }
  bool needs_contacts() const override { return true; }
  std::optional<SleepRing> ring() const override { return ring_; }
  std::vector<Reading> readings(const Frame<Dim>& frame, BodyIndex body) const override;
  void decide(const Frame<Dim>& frame, Decision<Dim>& decision) override;
  void note(const World<Dim>& world, std::span<const SleepEvent> events) override;
  void forget(BodyIndex body) override;
  std::optional<DriftEstimate> drift_estimate(const World<Dim>& world) const override {
    return rules_ ? rules_->checks().drift_estimate(world) : std::nullopt;
  }
  /// Notes of each body that decide() found awake whether it may have rested long enough after the next step, if that
  /// is about as long as the last one.
  void note_near_sleep(const World<Dim>& world, std::vector<std::uint8_t>& near) const;
  /// Null with a ring.
  const WakeRules<Dim>* rules() const { return rules_ ? &*rules_ : nullptr; }

 private:
  using Rest = typename RestCriterion<Dim>::Reference;

  /// A body's layer in the pile that scores it highest.
  struct Placement {
    int pile = -1;
    int layer = -1;
    double score = 0.0;
  };

  /// How long a body must have been at rest before it sleeps, in one gravity.
  struct RestTimes {
    double deep = 0.0;     // where the score is 1
    double surface = 0.0;  // where it is 0
    double woken = 0.0;    // of a body that woke and did not move
  };

  void find_wakes(RuleInput<Dim>& in);
  void choose_sleepers(const Frame<Dim>& frame, RuleInput<Dim>& in, Decision<Dim>& decision);
  bool below_ground(const RuleInput<Dim>& in, BodyIndex body) const;
  bool is_fast(const RuleInput<Dim>& in, BodyIndex body) const;
  RestTimes rest_times_in(const World<Dim>& world) const;
  double rest_time_needed(const Frame<Dim>& frame, BodyIndex body, const RestTimes& times) const;
  bool rested_enough(const Frame<Dim>& frame, const Rest& rest, const RestTimes& times) const;
  Placement placement(const Frame<Dim>& frame, BodyIndex body) const;

  std::optional<SleepRing> ring_;
  std::optional<WakeRules<Dim>> rules_;  // without a ring
  RestTimes rest_periods_;               // in sqrt(D/g)
  double extent_;                        // D [m]
  double ground_;                        // its height [m]; without ground the lowest number
  RestCriterion<Dim> rest_;
  SupportCriterion<Dim> support_;
  RuleOutput<Dim> output_;         // scratch
  std::vector<BodyIndex> bodies_;  // scratch
};

}  // namespace talus

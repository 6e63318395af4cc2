#pragma once
// Sleep by contact: the paper's layers say how readily a body may sleep, its contacts say whether.

#include <vector>

#include "common/policy/adaptive_params.h"
#include "common/policy/blows.h"
#include "common/policy/heavy_blows.h"
#include "common/policy/local_avalanches.h"
#include "common/policy/props.h"
#include "common/policy/rest_watch.h"
#include "common/policy/sleep_policy.h"
#include "common/policy/steering.h"

namespace talus {

/// A body sleeps alone when it has been at rest for a while and ground, sleepers or others that fall asleep with it
/// bear it; how long the while is follows from its pile's density and its closeness to the centre (section 3.3), or is
/// short where it slept before. It wakes when a blow reaches it, when what it rests on moves away, or where its heap
/// has grown too steep; nothing else wakes it.
template <int Dim>
class AdaptivePolicy final : public SleepPolicy<Dim> {
 public:
  /// `typical` gives D.
  AdaptivePolicy(const AdaptiveParams& params, const WorldDescription<Dim>& world, const TypicalBody& typical);

  bool counts_flying() const override { return false; }
  void decide(const Frame<Dim>& frame, Decision<Dim>& decision) override;

 private:
  /// The pile in which a body is most ready to sleep.
  struct Readiness {
    int pile = -1;
    int layer = -1;
    double score = 0.0;
  };

  /// `bodies` ascending.
  void wake(std::span<const BodyIndex> bodies, SleepCause cause, const Frame<Dim>& frame, Decision<Dim>& decision);
  void limit(std::span<Kick<Dim>> kicks) const;
  void choose_sleepers(const Frame<Dim>& frame, std::span<const Contact<Dim>> contacts, Decision<Dim>& decision);
  bool below_ground(const BodyStates<Dim>& states, BodyIndex body) const;
  bool rested_enough(const Frame<Dim>& frame, BodyIndex body) const;
  Readiness readiness(const Frame<Dim>& frame, BodyIndex body) const;

  AdaptiveParams params_;
  double dt_;
  double ground_;                // its height [m]; without ground the lowest number
  double fastest_;               // that a kick may leave a body, just below what the engines cut to [m/s]
  double fastest_spin_;          // likewise [rad/s]
  std::vector<double> weights_;  // [shape] g dt times mass [N s]
  RestWatch<Dim> rest_watch_;
  Props<Dim> props_;
  HeavyBlows<Dim> heavy_blows_;
  Blows<Dim> blows_;
  LocalAvalanches<Dim> avalanches_;
  Steering<Dim> steering_;
  std::vector<BodyIndex> bodies_;  // scratch
};

}  // namespace talus

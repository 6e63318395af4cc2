#pragma once
// What a sleep policy is: the part that decides which bodies sleep and which wake.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/policy/frame.h"

namespace talus {

/// A new velocity for a body that is awake or woken by the same decision.
template <int Dim>
struct VelocityChange {
  BodyIndex body = 0;
  Vec<Dim> velocity = Vec<Dim>::Zero();  // of the centre of mass [m/s]
  Spin<Dim> spin = Spin<Dim>::Zero();    // [rad/s]
};

/// A policy's decision for one frame: changes that are not made yet. In each event the policy sets all but
/// `step` and `woke`, which the simulation fills in.
template <int Dim>
struct Decision {
  std::vector<SleepEvent> freeze;
  std::vector<SleepEvent> thaw;
  std::vector<VelocityChange<Dim>> velocities;  // applied once the bodies to thaw are awake
};

/// A policy's estimate of the error of its sleeping bodies. What is told of it: told_drift().
struct DriftEstimate {
  double drift = 0.0;          // mean distance that the sleeping bodies are expected to move once all are woken [m]
  double checked_share = 0.0;  // of the sleeping bodies, for which this was measured; for the others it is extrapolated
};

/// A number that a policy goes by for one body.
struct Reading {
  std::string_view name;
  double value = 0.0;
  std::optional<double> threshold;  // what `value` is compared with; none: it is only known
  std::string_view unit;            // empty: a plain number
  std::string_view effect;          // of a value above the threshold; of no threshold: what the value says
};

template <int Dim>
class SleepPolicy {
 public:
  virtual ~SleepPolicy() = default;

  /// Whether decide() does anything. If not, piles are counted for observers only.
  virtual bool decides() const { return true; }

  /// Whether bodies that have touched nothing yet count in layers, for piles whose parameters leave it open.
  virtual bool counts_flying() const { return true; }

  /// Whether decide() reads the contacts of the step. If neither a policy nor an observer nor a pile does, steps do not
  /// record them.
  virtual bool needs_contacts() const { return false; }

  /// Which sleeping bodies take part in the contact solve: World::set_ring().
  virtual std::optional<SleepRing> ring() const { return std::nullopt; }

  /// None from a policy that does not measure it, has not yet, or cannot while many bodies move. Costs O(bodies +
  /// contacts).
  virtual std::optional<DriftEstimate> drift_estimate(const World<Dim>& /*world*/) const { return std::nullopt; }

  /// What the policy goes by for a body that is in the world, after a step. It leaves out what it does not have.
  virtual std::vector<Reading> readings(const Frame<Dim>& /*frame*/, BodyIndex /*body*/) const { return {}; }

  /// Of a layer, counted from the bottom.
  virtual LayerThresholds thresholds(std::size_t /*layer*/) const { return {}; }

  /// Fills `decision` (empty on entry). Called once a step. No body may be put to sleep that Frame::may_sleep()
  /// excludes.
  virtual void decide(const Frame<Dim>& frame, Decision<Dim>& decision) = 0;

  /// Called for each body that fell asleep or woke, right after it did, whatever the cause: the policy's decisions as
  /// far as they were carried out, the user, events, gravity, obstacles. A sleeping body that left the world comes as
  /// one that woke. What a policy keeps about sleeping bodies must follow from these calls alone.
  virtual void note(const World<Dim>& /*world*/, std::span<const SleepEvent> /*events*/) {}

  /// The number of an awake body is now that of another one, or the body was put elsewhere: what the policy keeps of it
  /// ends. Only in worlds that talus does not simulate.
  virtual void forget(BodyIndex /*body*/) {}
};

/// Writes the policy's thresholds into the layers of a pile.
template <int Dim>
void set_thresholds(const SleepPolicy<Dim>& policy, std::span<Layer> layers) {
  for (std::size_t i = 0; i < layers.size(); ++i) layers[i].thresholds = policy.thresholds(i);
}

/// Leaves all sleeping to the engine: policy `full` (the engine never sleeps) and `engine` (its own rule).
template <int Dim>
class NoPolicy final : public SleepPolicy<Dim> {
 public:
  bool decides() const override { return false; }
  void decide(const Frame<Dim>&, Decision<Dim>&) override {}
};

/// How far the sleeping bodies of a frame are expected to move on average once all are woken, as texts, files, messages
/// and pages have it.
struct ToldDrift {
  double drift = 0.0;          // [D], the largest extent of the typical body
  double checked_share = 0.0;  // of the sleeping bodies, for which this was measured
};

/// By the probe of the last state where there was one, which wakes all bodies; else by the policy, where it has an
/// estimate.
template <int Dim>
std::optional<ToldDrift> told_drift(const Frame<Dim>& frame) {
  if (frame.probed_drift) return ToldDrift{.drift = *frame.probed_drift, .checked_share = 1.0};
  const auto estimate = frame.policy == nullptr ? std::nullopt : frame.policy->drift_estimate(frame.world);
  if (!estimate) return std::nullopt;
  return ToldDrift{estimate->drift / frame.piles.typical_body().extent, estimate->checked_share};
}

}  // namespace talus

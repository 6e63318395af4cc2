#pragma once
// Sections 3.3 and 3.4 of "Piles of Objects" (Hsu and Keyser 2010), to the letter.

#include <cstdint>
#include <span>
#include <vector>

#include "common/policy/paper_params.h"
#include "common/policy/sleep_policy.h"

namespace talus {

/// A body sleeps when its layer is dense, it lies near the layer's centre, it is slow, and every layer below holds a
/// sleeper. A whole pile wakes when one of its layers is overfull or something with much momentum is about to hit it.
template <int Dim>
class PaperPolicy final : public SleepPolicy<Dim> {
 public:
  PaperPolicy(const PaperParams& params, const WorldDescription<Dim>& world);

  std::vector<Reading> readings(const Frame<Dim>& frame, BodyIndex body) const override;
  void decide(const Frame<Dim>& frame, Decision<Dim>& decision) override;
  LayerThresholds thresholds(std::size_t layer) const override;

 private:
  void wake_hit_piles(const Frame<Dim>& frame, Decision<Dim>& decision);
  void wake_overfull_piles(const Frame<Dim>& frame, Decision<Dim>& decision);
  void wake(std::size_t pile, SleepCause cause, const Frame<Dim>& frame, Decision<Dim>& decision);
  SleepEvent best_score(const Frame<Dim>& frame, BodyIndex body, std::span<const int> open) const;
  void choose_sleepers(const Frame<Dim>& frame, Decision<Dim>& decision) const;
  bool hits(const Frame<Dim>& frame, BodyIndex body);

  PaperParams params_;
  double dt_;
  std::vector<std::int64_t> body_rests_from_;  // [body] step before which it may not sleep again
  std::vector<std::int64_t> pile_calm_from_;   // [pile] step before which it starts no avalanche
  std::vector<std::uint8_t> pile_woken_;       // [pile] in this step
  std::vector<BodyIndex> near_;                // sleepers that a fast body is about to reach
};

/// The sleep score rho d v of section 3.3: density of the layer, closeness to its centre (equation (2)), and
/// v = 1 / (1 + speed) with the speed in m/s.
double sleep_score(double density, double closeness, double speed);

}  // namespace talus

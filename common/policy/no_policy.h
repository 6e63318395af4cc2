#pragma once

#include "common/policy/sleep_policy.h"

namespace talus {

/// Leaves all sleeping to the engine: policy `full` (the engine never sleeps) and `engine` (its own rule).
template <int Dim>
class NoPolicy final : public SleepPolicy<Dim> {
 public:
  bool decides() const override { return false; }
  void decide(const Frame<Dim>&, Decision<Dim>&) override {}
};

}  // namespace talus

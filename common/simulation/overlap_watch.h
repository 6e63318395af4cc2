#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/policy/frame.h"

namespace talus {

/// Measures how far bodies overlap each other, the ground and obstacles, by the depths of contacts. A sample is taken
/// about once in sqrt(D/g), in which gravity moves a body by D/2, and not more often than every 16 steps: so recording
/// the contacts costs less than a hundredth of a run, and an impact, which presses bodies into each other for a step
/// or two, shows in one sample at most. A pair overlaps where two samples in a row have found it so, or one after which
/// both fell asleep: contacts of sleepers alone are in no list. Costs O(contacts) a sample.
template <int Dim>
class OverlapWatch {
 public:
  /// A body of a pair that overlaps beyond the limit.
  struct Finding {
    BodyIndex body = 0;
    double depth = 0.0;  // [D]
  };

  /// `extent`: D [m]. `gravity` [m/s^2] and `dt` of a step [s] up to the first sample; `step`: number of the last one.
  OverlapWatch(double extent, double gravity, double dt, std::int64_t step = 0)
      : extent_(extent), next_(step + period(extent, gravity, dt)) {}

  /// Whether the step with this number is sampled, and so must record its contacts.
  bool due(std::int64_t step) const { return step >= next_; }

  /// After such a step. The gravity that it finds decides when the next one is due. Valid until the next call.
  std::span<const Finding> sample(const World<Dim>& world, std::int64_t step);

  const RunOverlap& overlap() const { return overlap_; }

 private:
  struct Pair {
    BodyIndex low = 0;  // below 0: ground or obstacle
    BodyIndex high = 0;
    double depth = 0.0;  // [D]

    auto bodies() const { return std::pair(low, high); }
  };
  static std::int64_t period(double extent, double gravity, double dt);
  void find_pairs(const World<Dim>& world);
  double lasting_depth(const World<Dim>& world, const Pair& before) const;

  double extent_;      // D [m]
  std::int64_t next_;  // number of the next step that is sampled
  std::vector<Pair> last_;
  std::vector<Pair> now_;
  std::vector<Finding> findings_;
  std::int64_t pairs_ = 0;        // in contact, over all samples
  std::int64_t overlapping_ = 0;  // pairs whose overlap lasted beyond the limit, over all samples
  RunOverlap overlap_;
};

}  // namespace talus

#pragma once
// How many bodies lie in each layer of a pile, kept up body by body.

#include <array>
#include <cstdint>
#include <vector>

#include "common/pile/pile.h"
#include "common/world/body.h"

namespace talus {

/// How a body counts in one pile.
template <int Dim>
struct CountedAs {
  /// Steps of a position per metre: 15 micrometres.
  static constexpr double steps_per_metre = 65536.0;

  std::int16_t layer = -1;  // -1: in no layer, does not count
  bool asleep = false;
  std::array<std::int64_t, Dim - 1> at{};  // horizontal position in steps: sums of integers are exact in any order
};

/// `body`, at its present place, in `pile`.
template <int Dim>
CountedAs<Dim> counted_as(const Pile<Dim>& pile, const BodyStates<Dim>& states, BodyIndex body);

/// The counts of one pile. Remembers how each body was counted, so that it can be uncounted exactly: the counts always
/// equal those made from the beginning.
template <int Dim>
class PileCounts {
 public:
  /// Makes room for more bodies, which do not count yet.
  void resize(std::size_t bodies) { counted_.resize(bodies); }
  /// Counts no body, neither here nor in the layers of `pile`.
  void clear(Pile<Dim>& pile, std::size_t bodies);
  /// Counts a body in the layers of `pile` in place of how it was counted last.
  void count(Pile<Dim>& pile, BodyIndex body, const CountedAs<Dim>& now);

  /// Bodies in the pile's layers.
  int bodies() const { return bodies_; }
  /// Mean horizontal coordinate of these bodies [m]; there must be one.
  double mean(std::size_t axis) const {
    return static_cast<double>(sum_[axis]) / (CountedAs<Dim>::steps_per_metre * bodies_);
  }
  /// Layer of a body, or -1.
  int layer_of(BodyIndex body) const { return body < std::ssize(counted_) ? counted_[body].layer : -1; }
  bool same_totals(const PileCounts& other) const { return bodies_ == other.bodies_ && sum_ == other.sum_; }

 private:
  void add(Pile<Dim>& pile, const CountedAs<Dim>& counted, int sign);

  std::vector<CountedAs<Dim>> counted_;      // by body
  std::array<std::int64_t, Dim - 1> sum_{};  // of CountedAs::at
  int bodies_ = 0;
};

}  // namespace talus

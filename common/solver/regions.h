#pragma once
// Parts of a heap that threads solve in parallel.

#include <span>
#include <vector>

#include "common/solver/solver_body.h"

namespace talus {

/// The moving bodies of a step in slabs of equal numbers, one behind the other along the axis in which they spread
/// most. Their number follows from that of the bodies and not from that of the threads, so that the solve gives the
/// same bits for any number of threads.
template <int Dim>
class Regions {
 public:
  static constexpr int most = 8;

  void divide(std::span<const SolverBody<Dim>> bodies);

  int count() const { return count_; }
  /// Of a body that moves.
  int of(int slot) const { return region_[slot]; }

 private:
  int count_ = 1;
  std::vector<int> region_;  // by slot
};

}  // namespace talus

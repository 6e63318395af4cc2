#pragma once
// What bodies that sleep cost those that are awake, on a bare world.

#include <cstddef>
#include <string>

namespace talus {

struct SleepersCost {
  int sleepers = 0;
  double step_ms = 0.0;         // with the awake bodies resting on the sleepers, median
  double idle_step_us = 0.0;    // with no body awake, median
  double freeze_thaw_us = 0.0;  // a body, both together
  double bytes = 0.0;           // of memory a sleeper, everything included
  double bytes_of_l = 0.0;      // the same of L shapes, which are of two pieces
};

/// A block of `sleepers` boxes (for `bytes_of_l` L shapes) of 1 m, and `awake` more at rest on top of it.
template <int Dim>
SleepersCost sleepers_cost(const std::string& backend, int sleepers, int awake);

}  // namespace talus

#pragma once

namespace talus {

/// Which sleeping bodies take part in the contact solve, and what wakes them. See Ring.
struct SleepRing {
  double extent = 1.0;        // D, that of the typical body [m]
  int rings = 2;              // contacts between a sleeping body and what moves, at most
  double still_speed = 0.01;  // faster sleeping bodies count as moving [speed_unit()]
};

}  // namespace talus

#pragma once

#include <cstdint>

namespace talus {

/// A contact point as a row of a structured array: Contact with the numbers of bodies, GivenContact with handles.
template <int Dim>
struct ContactRow {
  std::int64_t a;
  std::int64_t b;
  double point[Dim];
  double normal[Dim];
  double normal_impulse;
  double friction_impulse[Dim];
  double approach_speed;
  double depth;
};

}  // namespace talus

#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace talus {

/// How a pile comes to rest once the last body has been dropped.
struct ComingToRest {
  int bodies = 0;
  double dt = 0.0;                   // time step [s]
  double stopped = 0.0;              // from then until no body's centre is farther than 0.01 D from where it ends [s]
  double asleep = 0.0;               // from then until all sleep [s]; NaN: not within the time watched
  std::vector<double> step_seconds;  // processor time of each step after the last body was dropped

  /// Mean over the second that begins `from` seconds after the last body was dropped [s].
  double step_time(double from) const;
};

/// Pours the scene however long it takes and watches it for `calm` seconds more.
template <int Dim>
ComingToRest coming_to_rest(const Scene<Dim>& scene, const std::string& backend, double calm);

}  // namespace talus

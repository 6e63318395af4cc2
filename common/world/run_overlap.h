#pragma once

namespace talus {

/// Depth from which on the overlap of a pair counts as a fault [D].
inline constexpr double overlap_limit = 0.1;

/// What a run has shown of overlap so far.
struct RunOverlap {
  double deepest = 0.0;  // overlap of a pair that lasted [D]
  double share = 0.0;  // of the pairs in contact, over all samples: those whose overlap lasted at overlap_limit or more
};

}  // namespace talus

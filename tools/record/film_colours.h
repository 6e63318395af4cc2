#pragma once
// What the colours of a recorded run's bodies show.

#include <array>
#include <string>
#include <string_view>

#include "tools/picture/body_colours.h"
#include "tools/record/recorded_run.h"

namespace talus {

/// Ways to colour bodies: awake and asleep by shape in turn; by shape with its name; by size; by speed; by the layer
/// at, the cause of, or the time since the last time that the body fell asleep or woke.
inline constexpr std::array<std::string_view, 7> colour_words = {"state", "shape", "size", "speed",
                                                                 "layer", "cause", "age"};

/// Colours of the bodies of a recorded frame by one of `colour_words`; none for "state". Scales are the same in all
/// frames of a run.
template <int Dim>
BodyColours colours_at(const RecordedRun<Dim>& run, int frame, std::string_view word);

}  // namespace talus

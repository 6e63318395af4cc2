#pragma once
// What the colours of a recorded run's bodies show.

#include <string>
#include <string_view>
#include <vector>

#include "tools/picture/body_colours.h"
#include "tools/record/recorded_run.h"

namespace talus {

/// The ways to colour bodies, in the order of the manual: "state", the default colours of pictures; "shape"; "size";
/// "speed"; and of the last time that a body fell asleep or woke its "layer", its "cause" and its "age".
std::vector<std::string> colour_words();

/// Colours of the bodies of a recorded run. Scales are the same in all frames.
template <int Dim>
class FilmColours {
 public:
  /// `word`: one of colour_words(), else throws std::invalid_argument. The run must outlive this.
  FilmColours(const RecordedRun<Dim>& run, std::string_view word);

  /// None for "state". May be called from several threads at once. O(bodies), times the logarithm of a body's events.
  BodyColours at(int frame) const;

 private:
  const RecordedRun<Dim>& run_;
  std::string_view word_;
  std::vector<std::vector<const SleepEvent*>> events_;  // of each body, by step
};

}  // namespace talus

#pragma once

#include <array>
#include <string_view>

namespace talus {

/// Where the time of one step, or of several, went [s].
struct PhaseTimes {
  double emit = 0.0;
  double step = 0.0;
  double collide = 0.0;
  double solve = 0.0;
  double read = 0.0;
  double count = 0.0;
  double decide = 0.0;
  double apply = 0.0;
  double observe = 0.0;

  double total() const { return emit + step + count + decide + apply + observe; }
};

/// A part of a step, with its name in files.
struct Phase {
  std::string_view name;
  std::string_view meaning;
  double PhaseTimes::*time;
};

inline constexpr std::array<Phase, 9> all_phases = {{
    {"emit", "adding bodies", &PhaseTimes::emit},
    {"step", "the engine's step", &PhaseTimes::step},
    {"collide", "of it: finding contacts", &PhaseTimes::collide},
    {"solve", "of it: solving and moving", &PhaseTimes::solve},
    {"read", "of it: copying states and contacts out", &PhaseTimes::read},
    {"count", "counting piles", &PhaseTimes::count},
    {"decide", "the policy", &PhaseTimes::decide},
    {"apply", "freezing and thawing", &PhaseTimes::apply},
    {"observe", "observers of the step before", &PhaseTimes::observe},
}};

inline PhaseTimes& operator+=(PhaseTimes& sum, const PhaseTimes& more) {
  for (const Phase& phase : all_phases) sum.*phase.time += more.*phase.time;
  return sum;
}

}  // namespace talus

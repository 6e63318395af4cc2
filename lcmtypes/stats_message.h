#pragma once
// talus_stats: numbers of a step, the warnings of the run, and where its time went.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/policy/frame.h"
#include "lcmtypes/channels.h"

namespace talus {

/// Counts, kinetic energy and warnings; the rest stays at 0, `contacts` at -1. Costs O(awake), and a pass
/// over the `removed` flags.
template <int Dim>
talus_lcm::talus_stats to_stats(const Frame<Dim>& frame);

/// Writes the mean times of `steps` > 0 steps, from their sum.
void set_phase_times(const PhaseTimes& sum, std::int64_t steps, talus_lcm::talus_stats& message);
/// The times of one step that a message has [ms].
PhaseTimes phase_times_of(const talus_lcm::talus_stats& message);

/// The estimate of drift [D]; nothing where it is not known.
std::optional<double> drift_of(const talus_lcm::talus_stats& message);
std::vector<Warning> warnings_of(const talus_lcm::talus_stats& message);

/// The first value that is out of its range, or nothing (see decode()).
std::string_view range_fault(const talus_lcm::talus_stats& message);

}  // namespace talus

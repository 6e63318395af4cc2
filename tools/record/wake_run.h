#pragma once
// The test of a recorded run's sleeping bodies.

#include <nlohmann/json.hpp>

#include "common/measure/wake_test.h"
#include "tools/record/recorded_run.h"

namespace talus {

/// The world at the end of the record.
template <int Dim>
WorldDescription<Dim> world_at_end(const RecordedRun<Dim>& run);

/// Wakes all bodies of the last state and simulates on at the reference settings. Throws std::invalid_argument where
/// the record has no engine or no body; `folder` is for messages.
template <int Dim>
WakeTest wake(const RecordedRun<Dim>& run, double seconds, const std::string& folder);

/// D over the bodies there are [m].
template <int Dim>
double mean_extent(const RecordedRun<Dim>& run);

/// Keys as in docs/files.md; lengths in `extent` [m].
nlohmann::ordered_json wake_json(const WakeTest& test, double extent);

}  // namespace talus

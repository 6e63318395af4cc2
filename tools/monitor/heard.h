#pragma once
// What a monitor has heard: the runs with numbers, and how each is named on its screen.

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/monitor/faults.h"
#include "tools/monitor/listener.h"

namespace talus {

/// What there is to show.
struct Heard {
  const Listener& listener;
  Faults faults;
  std::string address;
  std::chrono::steady_clock::time_point now;
};

/// A run of which messages were received.
struct HeardRun {
  std::int64_t id = 0;
  int number = 0;  // from 1, in the order in which the runs came
  const RunTable::Entry* entry = nullptr;
  const RunView& view() const { return entry->view; }
};

/// All runs, in the order in which they came.
std::vector<HeardRun> runs_of(const Heard& heard);

/// Scene, backend and policy.
std::string name_of(const RunView& view);

/// Why the run ended, or for how long it has been silent; empty: it goes on.
std::string state_of(const Heard& heard, const HeardRun& run);

/// A count >= 0 in so many characters: 9999, 123k, 45M.
std::string count_text(double number, int characters = 6);

}  // namespace talus

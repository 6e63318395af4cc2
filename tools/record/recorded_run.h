#pragma once
// A run folder read back.

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "common/measure/trajectory.h"
#include "common/scene/scene.h"
#include "common/policy/sleep_event.h"

namespace talus {

/// What scene.toml and run.lcm of a run folder hold.
template <int Dim>
struct RecordedRun {
  explicit RecordedRun(const Scene<Dim>& as_run) : scene(as_run), frames(as_run.world.dt, as_run.steps_per_frame()) {}

  std::string name;     // of the folder
  std::string backend;  // that the run was on
  std::string policy;
  std::string reason;      // why it ended; empty: it was killed
  Scene<Dim> scene;        // as it was run
  Trajectory<Dim> frames;  // poses at each frame of output
  BodyStates<Dim> last;    // the last recorded state. A record has no velocities: those of the awake are the mean ones
                           // since the record before
  std::int64_t last_step = 0;
  std::vector<SleepEvent> events;   // all of the run, in order
  std::uint64_t damaged_bytes = 0;  // that had to be left out
};

using AnyRecordedRun = std::variant<RecordedRun<2>, RecordedRun<3>>;

/// Reads the run folder. Throws std::invalid_argument where it is none, where run.lcm belongs to another scene, or
/// where damage took a frame out of the middle; std::system_error where a file cannot be read.
AnyRecordedRun read_run(const std::filesystem::path& folder);

}  // namespace talus

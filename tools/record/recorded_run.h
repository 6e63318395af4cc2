#pragma once
// A run folder read back.

#include <filesystem>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "common/measure/trajectory.h"
#include "common/policy/sleep_event.h"
#include "common/scene/happened.h"
#include "common/scene/read_scene.h"
#include "common/scene/scene.h"
#include "lcmtypes/log_reader.h"
#include "tools/record/recorded_scene.h"

namespace talus {

/// What of a record could not be used.
struct RecordDamage {
  std::uint64_t bytes = 0;               // that are no message
  std::int64_t undecodable = 0;          // messages whose checksum holds and that are of another kind all the same
  std::vector<std::int64_t> lost_steps;  // steps of the frames of output that are missing between others
  std::int64_t lost_events = 0;          // messages with sleep events that are missing between others
  int unknown_bodies = 0;                // bodies whose pose in the last state is older than that state

  bool none() const { return bytes == 0 && undecodable == 0 && lost_steps.empty() && lost_events == 0; }
};

/// One line, as "1 frame left out (step 80), 57 damaged bytes"; empty where there is no damage.
std::string text_of(const RecordDamage& damage);

/// What a record holds.
template <int Dim>
struct RecordedRun {
  explicit RecordedRun(const Scene<Dim>& as_run)
      : scene(as_run), frames(as_run.world.dt, as_run.steps_per_frame(), as_run.world.periodic()) {}

  std::string name;     // of the folder, printable
  std::string backend;  // that the run was on; empty: no message has it
  std::string policy;
  std::string reason;      // why it ended; empty: it was killed
  Scene<Dim> scene;        // as it was run
  Trajectory<Dim> frames;  // poses at each frame of output; lost where the record is damaged
  std::vector<std::vector<ContactForce<Dim>>> contacts;  // of each of these; empty where the run told none
  BodyStates<Dim> last;  // the last recorded state; velocities are zero, since a record has none
  std::int64_t last_step = 0;
  std::vector<SleepEvent> events;  // in order
  std::vector<DoneEvent> done;     // events of the scene, in order
  RecordDamage damage;
};

using AnyRecordedRun = std::variant<RecordedRun<2>, RecordedRun<3>>;

/// The own name of a run folder or record, printable.
std::string name_of_run(const std::filesystem::path& folder);

/// The error of a record without a frame.
std::invalid_argument no_frame(const std::filesystem::path& folder, std::uint64_t damaged_bytes);

/// Reads a run folder, or a record without its folder; damage costs what it hit. Throws std::invalid_argument where it
/// is none, where the record belongs to another scene, holds several runs or no frame; std::system_error where a file
/// cannot be read.
AnyRecordedRun read_run(const std::filesystem::path& folder);

/// Reads the record of a run of this scene; `folder` is for messages. Throws as read_run() does.
AnyRecordedRun read_record(const AnyScene& scene, LogReader& log, const std::filesystem::path& folder);

/// The bytes of the log of a run folder, or of a record without its folder, from which read_run() can read a run.
/// Throws as that does.
std::string record_bytes(const std::filesystem::path& folder);

}  // namespace talus

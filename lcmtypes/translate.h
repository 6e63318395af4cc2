#pragma once
// The one translation from the core's terms to messages, for the live view and for the record. Headers, numbers and
// checksums come later, from MessageEncoder. What is too much for one message comes in several, none above
// max_message_bytes.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/policy/frame.h"
#include "common/policy/sleep_policy.h"
#include "common/scene/scene.h"
#include "common/world/motion.h"
#include "lcmtypes/encode.h"
#include "lcmtypes/run_info.h"

namespace talus {

/// `phase` as in talus_run; `channels` are those that the run sends on, with the numbers that `encoder` has reached.
talus_lcm::talus_run to_run(const RunInfo& info, std::int8_t phase, std::string_view reason,
                            std::span<const Channel> channels, const MessageEncoder& encoder);

/// One message at least, also where there is no pile yet.
std::vector<talus_lcm::talus_piles> to_piles(std::span<const Pile<3>> piles);

/// No message where there are no events.
std::vector<talus_lcm::talus_sleep> to_sleep(std::span<const SleepEvent> events);

/// Counts, kinetic energy and warnings; the rest stays at 0, `contacts` at -1. Costs O(awake), and a pass
/// over the `removed` flags.
template <int Dim>
talus_lcm::talus_stats to_stats(const Frame<Dim>& frame);

/// Writes the mean times of `steps` > 0 steps, from their sum.
void set_phase_times(const PhaseTimes& sum, std::int64_t steps, talus_lcm::talus_stats& message);
/// The times of one step that a message has [ms].
PhaseTimes phase_times_of(const talus_lcm::talus_stats& message);

/// The events of a message that has passed decode().
std::vector<SleepEvent> events_of(const talus_lcm::talus_sleep& message);

/// The estimate of drift [D]; nothing where it is not known.
std::optional<double> drift_of(const talus_lcm::talus_stats& message);

/// The warnings of a message.
std::vector<Warning> warnings_of(const talus_lcm::talus_stats& message);

/// Poses of `bodies`, ascending. One message at least.
template <int Dim>
std::vector<talus_lcm::talus_bodies> to_bodies(const BodyStates<Dim>& states, std::span<const BodyIndex> bodies,
                                               bool key_frame);

/// All shapes of bodies, then all obstacles, one message each. Throws std::invalid_argument when a shape has so many
/// corners that it does not fit one message.
template <int Dim>
std::vector<talus_lcm::talus_shapes> to_shapes(const WorldDescription<Dim>& world);

/// All events of a scene, none of which has happened.
template <int Dim>
std::vector<talus_lcm::talus_event> to_events(const Scene<Dim>& scene);

/// Says that the event has happened, just before the frame's step of `dt` [s].
template <int Dim>
void set_happened(const Frame<Dim>& frame, double dt, talus_lcm::talus_event& message);

/// The files of a scene that was read from TOML, in parts; none of another. Throws std::system_error where one cannot
/// be read.
template <int Dim>
std::vector<talus_lcm::talus_scene> to_scene_files(const Scene<Dim>& scene);

/// The pile of a message that decode() took; that of a plane scene lies in y = 0.
Pile<3> pile_of(const talus_lcm::talus_pile& message);

/// Empty if there are no poses.
template <int Dim>
std::vector<talus_lcm::talus_obstacles> to_obstacles(std::span<const ObstaclePose<Dim>> poses);

/// Puts an obstacle elsewhere.
template <int Dim>
void set_pose(const Pose<Dim>& pose, talus_lcm::talus_shapes& message);

/// The shape of a message that decode() took. Throws std::invalid_argument on what is no shape.
template <int Dim>
Shape<Dim> to_shape(const talus_lcm::talus_shapes& message);
/// The pose of its obstacle.
template <int Dim>
Pose<Dim> pose_of(const talus_lcm::talus_shapes& message);

}  // namespace talus

#pragma once
// talus_bodies: poses of the bodies that moved, or of all.

#include <span>
#include <string_view>
#include <vector>

#include "common/moment/moment.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/message.h"

namespace talus {

/// Poses of `bodies`, ascending. One message at least.
template <int Dim>
std::vector<talus_lcm::talus_bodies> to_bodies(const BodyStates<Dim>& states, std::span<const BodyIndex> bodies,
                                               bool key_frame);

/// Puts poses together again: a frame names only the bodies that moved. Where frames are missing, the pose of each body
/// that may have moved in them is unknown until a later frame names it, at the latest the next key frame.
class BodiesReader {
 public:
  /// Whether `message`, checked by decode(), was the last part of a whole frame, which `bodies` then are at step(). A
  /// frame without all its parts, or of a step that is over, changes nothing.
  bool take(const talus_lcm::talus_bodies& message, MomentBodies& bodies);

  /// `body` fell asleep or woke since the last frame.
  void note_event(BodyIndex body) { events_.push_back(body); }
  /// Not all of these events are known.
  void note_lost_events() { events_lost_ = true; }

  std::int64_t step() const { return step_; }

 private:
  void apply(MomentBodies& bodies);
  void doubt(MomentBodies& bodies);
  void set(const talus_lcm::talus_bodies& message, std::size_t entry, MomentBodies& bodies);

  Parts<talus_lcm::talus_bodies> parts_;
  std::int64_t next_number_ = 0;
  std::int64_t step_ = 0;
  std::vector<std::uint8_t> seen_;  // bodies that a key frame names; others are gone
  std::vector<BodyIndex> events_;   // bodies that fell asleep or woke since the last frame
  bool events_lost_ = false;        // since the last frame
};

/// The first value that is out of its range, or nothing (see decode()).
std::string_view range_fault(const talus_lcm::talus_bodies& message);

}  // namespace talus

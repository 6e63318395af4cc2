#pragma once

#include <vector>

#include "common/world/body.h"
#include "lcmtypes/channels.h"

namespace talus {

/// Puts a record's poses together again: a frame names only the bodies that moved. Where frames are missing, the pose
/// of each body that may have moved in them is unknown until a later frame names it, at the latest the next key frame.
template <int Dim>
class StateReader {
 public:
  /// `bodies`: how many there may be, `shapes`: how many of these there are.
  StateReader(int bodies, int shapes) : bodies_(bodies), shapes_(shapes) {}

  /// Whether `message`, checked by decode(), was the last part of a whole frame, so that states() is the state
  /// at step(). A frame without all its parts, or of a step that is over, changes nothing. Throws std::invalid_argument
  /// where the message names a body or shape that the scene does not have.
  bool take(const talus_lcm::talus_bodies_v1& message);

  /// Notes that `body` fell asleep or woke since the last frame. Throws std::invalid_argument like take().
  void note_event(BodyIndex body);
  /// Notes that not all of these events are known.
  void note_lost_events() { events_lost_ = true; }

  /// All velocities zero.
  const BodyStates<Dim>& states() const { return states_; }
  /// Per body, whether its pose may not be that of step().
  const std::vector<std::uint8_t>& unknown() const { return unknown_; }
  std::int64_t step() const { return step_; }

 private:
  using Message = talus_lcm::talus_bodies_v1;

  void check(const Message& message) const;
  void grow(std::size_t bodies);
  void apply();
  void doubt();
  void set(const Message& message, std::size_t entry);

  int bodies_;
  int shapes_;
  std::vector<Message> parts_;  // of the frame that is being read
  std::int64_t next_number_ = 0;
  BodyStates<Dim> states_;
  std::int64_t step_ = 0;
  std::vector<std::uint8_t> unknown_;
  std::vector<std::uint8_t> seen_;  // bodies that a key frame names; others are gone
  std::vector<BodyIndex> events_;   // bodies that fell asleep or woke since the last frame
  bool events_lost_ = false;        // since the last frame
};

}  // namespace talus

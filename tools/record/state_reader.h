#pragma once

#include <vector>

#include "common/world/body.h"
#include "lcmtypes/channels.h"

namespace talus {

/// Puts a record's poses together again: a frame names only who moved.
template <int Dim>
class StateReader {
 public:
  /// `bodies`: how many there may be, `shapes`: how many of these there are.
  StateReader(int bodies, int shapes) : bodies_(bodies), shapes_(shapes) {}

  /// Whether `message`, sound as decode() leaves it, was the last part of its frame, so that states() is the state at
  /// step(). Throws std::invalid_argument where it names a body or shape that cannot be.
  bool take(const talus_lcm::talus_bodies_v1& message);

  /// All velocities zero.
  const BodyStates<Dim>& states() const { return states_; }
  std::int64_t step() const { return step_; }

  /// The same with velocities of the awake bodies: the mean since the frame before. `dt` of a step in s.
  BodyStates<Dim> states_with_velocities(double dt) const;

 private:
  void begin(const talus_lcm::talus_bodies_v1& message);
  void set(const talus_lcm::talus_bodies_v1& message, std::size_t entry);

  int bodies_;
  int shapes_;
  BodyStates<Dim> states_;
  BodyStates<Dim> before_;  // a frame earlier
  std::int64_t step_ = 0;
  std::int64_t step_before_ = 0;
  std::vector<std::uint8_t> seen_;  // bodies that a key frame names; who is missing is gone
};

}  // namespace talus

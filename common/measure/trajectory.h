#pragma once
// Where every body was, frame by frame: what the measures compare.

#include <cstdint>
#include <span>
#include <vector>

#include "common/policy/observer.h"
#include "common/world/body.h"
#include "common/world/periodic.h"

namespace talus {

/// Poses of all bodies at each frame of output, in single precision, which is what the engines compute in: nothing of
/// theirs is lost. 29 bytes per body and frame in 3D, 13 in 2D. A body is absent before its emission and after its
/// removal. What a damaged record lost is unknown: a body whose pose is unknown counts as absent, and same()
/// leaves it out.
template <int Dim>
class Trajectory {
 public:
  /// `step_time` [s] > 0 is the dt of a step, `steps_per_frame` >= 1; `periodic`: sides of the world. Throws
  /// std::invalid_argument.
  explicit Trajectory(double step_time, std::int64_t steps_per_frame = 1, const Periodic<Dim>& periodic = {});

  /// Adds a frame: the states after step number `step`. Frames follow one another at the distance of steps_per_frame,
  /// and bodies never become fewer; throws std::invalid_argument otherwise. `unknown` flags, per body, poses that are
  /// not known; empty: all are known.
  void append(const BodyStates<Dim>& states, std::int64_t step, std::span<const std::uint8_t> unknown = {});

  /// Adds a frame of which nothing is known.
  void append_lost(std::int64_t step);

  double step_time() const { return step_time_; }
  std::int64_t steps_per_frame() const { return steps_per_frame_; }
  double frame_time() const { return step_time_ * static_cast<double>(steps_per_frame_); }  // [s]

  int frames() const { return static_cast<int>(first_.size()); }
  std::int64_t step(int frame) const { return first_step_ + frame * steps_per_frame_; }

  /// Whether nothing is known of a frame.
  bool lost(int frame) const { return lost_[frame] != 0; }

  /// Bodies added by the last frame, by a given frame; 0 for a lost frame.
  BodyIndex bodies() const { return static_cast<BodyIndex>(shape_.size()); }
  BodyIndex bodies(int frame) const;
  int shape(BodyIndex body) const { return shape_[body]; }

  bool present(int frame, BodyIndex body) const {
    return body < bodies(frame) && (flags_[entry(frame, body)] & present_flag) != 0;
  }
  /// For present bodies only.
  bool asleep(int frame, BodyIndex body) const { return (flags_[entry(frame, body)] & asleep_flag) != 0; }
  Vec<Dim> position(int frame, BodyIndex body) const;
  Rotation<Dim> rotation(int frame, BodyIndex body) const;
  /// The way between two places [m]: through periodic sides where that is shorter.
  Vec<Dim> way(const Vec<Dim>& from, const Vec<Dim>& to) const { return periodic_.near(to, from) - from; }

  /// Whether body `body` of two trajectories is the same bit for bit at a frame, absence included. True where either is
  /// unknown.
  bool same(int frame, const Trajectory& other, BodyIndex body) const;

 private:
  static constexpr std::uint8_t present_flag = 1;
  static constexpr std::uint8_t asleep_flag = 2;
  static constexpr std::uint8_t unknown_flag = 4;
  std::size_t entry(int frame, BodyIndex body) const { return first_[frame] + body; }

  bool unknown(int frame, BodyIndex body) const {
    return lost(frame) || (body < bodies(frame) && (flags_[entry(frame, body)] & unknown_flag) != 0);
  }
  void begin_frame(std::int64_t step_number, bool lost);

  double step_time_;
  std::int64_t steps_per_frame_;
  Periodic<Dim> periodic_;
  std::int64_t first_step_ = 0;
  std::vector<std::size_t> first_;   // entry of body 0, per frame
  std::vector<std::uint8_t> lost_;   // per frame
  std::vector<int> shape_;           // per body
  std::vector<float> poses_;         // per entry
  std::vector<std::uint8_t> flags_;  // per entry
};

/// Records a trajectory while a simulation runs, every `steps_per_frame` steps.
template <int Dim>
class TrajectoryRecorder : public Observer<Dim> {
 public:
  TrajectoryRecorder(double step_time, std::int64_t steps_per_frame, const Periodic<Dim>& periodic = {})
      : trajectory_(step_time, steps_per_frame, periodic) {}
  void on_frame(const Frame<Dim>& frame) override {
    if (frame.step % trajectory_.steps_per_frame() == 0) trajectory_.append(frame.world.states(), frame.step);
  }
  const Trajectory<Dim>& trajectory() const { return trajectory_; }

 private:
  Trajectory<Dim> trajectory_;
};

}  // namespace talus

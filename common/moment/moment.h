#pragma once
// A run at one step, in 2D or 3D, as all that shows, stores or exports it takes it.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/math/pose_values.h"
#include "common/pile/pile.h"
#include "common/policy/sleep_event.h"
#include "common/scene/happened.h"
#include "common/world/body.h"
#include "common/world/motion.h"
#include "common/world/warning.h"

namespace talus {

template <int Dim>
struct Frame;

/// Poses in single precision, which is what engines compute in: nothing of theirs is lost, whole turns included.
class PoseList {
 public:
  /// 2 or 3.
  explicit PoseList(int dimension) : dimension_(dimension), width_(dimension == 2 ? pose_values<2> : pose_values<3>) {}

  int dimension() const { return dimension_; }
  std::size_t size() const { return values_.size() / width_; }
  /// New poses are those of no shift and no turn.
  void resize(std::size_t poses);

  /// Its numbers (common/math/pose_values.h).
  std::span<const float> operator[](std::size_t i) const { return std::span(values_).subspan(i * width_, width_); }
  void set(std::size_t i, std::span<const float> values);
  template <int Dim>
  void set(std::size_t i, const Pose<Dim>& pose);
  /// In the list's own dimension.
  template <int Dim>
  Pose<Dim> pose(std::size_t i) const {
    return pose_from<Dim>((*this)[i]);
  }
  /// A plane scene lies in y = 0.
  Pose<3> in_space(std::size_t i) const;

 private:
  int dimension_;
  std::size_t width_;
  std::vector<float> values_;
};

/// Every body so far; entry i belongs to body i.
struct MomentBodies {
  explicit MomentBodies(int dimension) : pose(dimension) {}

  std::vector<int> shape;
  PoseList pose;
  std::vector<std::uint8_t> asleep;
  std::vector<std::uint8_t> removed;
  std::vector<std::uint8_t> unknown;  // 1: its pose may be another one, since messages are missing
  std::vector<std::int8_t> cause;     // why it last fell asleep or woke, as SleepCause; -1: neither yet, or not known

  BodyIndex size() const { return static_cast<BodyIndex>(shape.size()); }
  /// Whether it is in the world, at a known pose.
  bool shows(BodyIndex body) const { return removed[body] == 0 && unknown[body] == 0; }
};

/// A run at one step.
struct Moment {
  explicit Moment(int dimension) : bodies(dimension), obstacle_pose(dimension) {}

  int dimension() const { return bodies.pose.dimension(); }

  std::int64_t step = 0;
  double time = 0.0;  // [s] simulated
  MomentBodies bodies;
  std::vector<SleepEvent> events;         // since the moment before, in order
  std::vector<Pile<3>> piles;             // with the policy's thresholds; bases of a plane scene lie in y = 0
  std::vector<Warning> warnings;          // all so far, one of each kind
  double kinetic_energy = 0.0;            // [J]
  std::optional<double> drift;            // mean distance that the sleeping bodies are expected to move once woken [D]
  std::vector<DoneEvent> done;            // events of the scene, all so far
  std::vector<int> moved_obstacle;        // those that may have moved, ascending
  PoseList obstacle_pose;                 // theirs
  std::vector<ContactForce<3>> contacts;  // where the run tells them; those of a plane scene lie in y = 0
};

/// The moment of a finished step: of the causes those of the step's own events, of the obstacles all that move by plan.
template <int Dim>
Moment moment_of(const Frame<Dim>& frame);

/// The piles of a moment, before it is made.
template <int Dim>
std::vector<Pile<3>> piles_in_space(const Frame<Dim>& frame);

/// The states of a moment of this dimension; velocities are zero.
template <int Dim>
BodyStates<Dim> states_of(const Moment& moment);

/// Its contacts.
template <int Dim>
std::vector<ContactForce<Dim>> contacts_of(const Moment& moment);

}  // namespace talus

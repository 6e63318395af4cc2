#pragma once
// The force that bodies put on the ground and on obstacles.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "common/world/world.h"

namespace talus {

/// Force [N] along each axis, then torque [N m]: one number in 2D, three in 3D.
template <int Dim>
using Wrench = Eigen::Matrix<double, Dim == 2 ? 3 : 6, 1>;

/// Mean, least and greatest of the steps' values, each number for itself. All zero without steps.
template <int Dim>
struct LoadSpan {
  Wrench<Dim> mean = Wrench<Dim>::Zero();
  Wrench<Dim> least = Wrench<Dim>::Zero();
  Wrench<Dim> most = Wrench<Dim>::Zero();
  std::int64_t steps = 0;
  bool known = true;  // false: there were sleeping bodies whose forces are not known

  void add(const Wrench<Dim>& value);
};

/// Sums the impulses of contacts over each step, of awake bodies and of sleeping ones. Forces of sleeping bodies are
/// known where a ring keeps them (World::set_ring()). What resists rolling has no part in the torque.
template <int Dim>
class LoadMeter {
 public:
  LoadMeter(const Scene<Dim>& scene, const LoadParams<Dim>& params);
  /// Of the ground and all obstacles together.
  explicit LoadMeter(const Scene<Dim>& scene);

  /// To be called after each step, while World::contacts() are those of the step and no body has fallen asleep or woken
  /// since.
  void update(const World<Dim>& world);

  /// Of all steps so far.
  const LoadSpan<Dim>& whole() const { return whole_; }
  /// Ends a frame of output. Its steps, where it has any, are then those of frame().
  void end_frame();
  const LoadSpan<Dim>& frame() const { return frame_; }
  /// Force between each two of LoadParams::heights, mean over the frame [N].
  const std::vector<Vec<Dim>>& profile() const { return profile_; }
  /// Why forces are not known; empty where all are.
  const std::string& reason() const { return reason_; }

 private:
  LoadMeter(const Scene<Dim>& scene, std::vector<BodyIndex> sides, const LoadParams<Dim>& params);
  bool all_forces_known(const World<Dim>& world);
  void add(std::span<const Contact<Dim>> contacts, Wrench<Dim>& sum);

  std::vector<BodyIndex> sides_;  // ascending
  Vec<Dim> about_;
  std::vector<double> heights_;
  std::vector<Vec<Dim>> profile_;
  std::vector<Vec<Dim>> next_profile_;  // impulses so far [N s]
  double dt_ = 0.0;
  std::vector<BodyIndex> asleep_from_start_;
  std::vector<Contact<Dim>> sleeping_;  // scratch
  LoadSpan<Dim> whole_;
  LoadSpan<Dim> frame_;
  LoadSpan<Dim> next_frame_;
  std::string reason_;
};

}  // namespace talus

#pragma once

#include <vector>

#include "common/scene/scene.h"
#include "common/world/world.h"

namespace talus {

/// Whether a world has come to rest, for `[run] until = "rest"`: within `rest_time` no awake body was added or woke,
/// no point of one moved farther than `rest_distance`, and gravity did not change. Sleeping bodies do not move. Looked
/// at once in each such time, which is rounded to whole frames of output.
template <int Dim>
class RestCheck {
 public:
  static constexpr double rest_time = 4.0;       // [sqrt(D/g)]
  static constexpr double rest_distance = 0.01;  // [D]

  explicit RestCheck(const Scene<Dim>& scene);

  /// After each step; `step` counts the steps done. Whether the world has been at rest up to this step.
  bool update(const World<Dim>& world, std::int64_t step);

 private:
  bool has_rested(const World<Dim>& world) const;
  std::int64_t period_in(const World<Dim>& world) const;

  double extent_;                        // D [m]
  double frame_time_;                    // of the output [s]
  std::int64_t steps_per_frame_;         // of the output
  std::vector<BodyIndex> bodies_;        // awake at the last look
  std::vector<Pose<Dim>> poses_;         // of these
  std::int64_t looked_at_ = 0;           // step of the last look; 0: none yet
  Vec<Dim> gravity_ = Vec<Dim>::Zero();  // at the last look [m/s^2]
};

}  // namespace talus

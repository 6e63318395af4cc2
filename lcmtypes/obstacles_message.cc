#include "lcmtypes/obstacles_message.h"

#include <algorithm>

#include "common/math/pose_values.h"
#include "lcmtypes/message.h"

namespace talus {

using talus_lcm::talus_obstacles;

template <int Dim>
std::vector<talus_obstacles> to_obstacles(std::span<const ObstaclePose<Dim>> poses) {
  constexpr std::span fields = layout<talus_obstacles>;
  constexpr std::size_t at_most = room<talus_obstacles> / (bytes_per_entry(fields, "obstacle_count") +
                                                           pose_values<Dim> * bytes_per_entry(fields, "value_count"));
  std::vector<talus_obstacles> messages;
  for (; !poses.empty(); poses = poses.subspan(messages.back().obstacle.size())) {
    talus_obstacles& message = messages.emplace_back();
    message.dimension = Dim;
    for (const ObstaclePose<Dim>& each : poses.first(std::min(poses.size(), at_most))) {
      message.obstacle.push_back(each.obstacle);
      append_pose<Dim>(each.pose, message.poses);
    }
    message.obstacle_count = static_cast<std::int32_t>(message.obstacle.size());
    message.value_count = static_cast<std::int32_t>(message.poses.size());
  }
  return messages;
}
template std::vector<talus_obstacles> to_obstacles<2>(std::span<const ObstaclePose<2>>);
template std::vector<talus_obstacles> to_obstacles<3>(std::span<const ObstaclePose<3>>);

std::string_view range_fault(const talus_obstacles& m) {
  if (!header_holds(m)) return "header out of range";
  if (m.dimension != 2 && m.dimension != 3) return "dimension is neither 2 nor 3";
  if (m.value_count != m.obstacle_count * (m.dimension == 2 ? 3 : 7)) return "values do not match obstacles";
  if (!ascend(m.obstacle)) return "obstacles not ascending";
  if (m.obstacle_count > 0 && m.obstacle.front() < 0) return "negative obstacle";
  return {};
}

}  // namespace talus

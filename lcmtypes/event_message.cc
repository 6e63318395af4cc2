#include "lcmtypes/event_message.h"

#include <algorithm>

#include "common/scene/happened.h"
#include "lcmtypes/message.h"

namespace talus {

using talus_lcm::talus_event;

template <int Dim>
std::vector<talus_event> to_events(const Scene<Dim>& scene) {
  std::vector<talus_event> messages(scene.events.size());
  for (std::size_t i = 0; i < scene.events.size(); ++i) {
    const Event<Dim>& event = scene.events[i];
    talus_event& message = messages[i];
    message.number = static_cast<std::int32_t>(i);
    message.total = static_cast<std::int32_t>(scene.events.size());
    message.happened_step = -1;
    message.happened_time = -1.0;
    message.action = to_string(event.action);
    message.text = clipped(event_text(scene, message.number));
    const ObstacleName name = event.obstacle ? scene.obstacle_names[*event.obstacle] : ObstacleName();
    const int most = static_cast<int>((max_message_bytes - 3000) / sizeof(std::int32_t));
    for (int k = 0; k < std::min(name.count, most); ++k) message.obstacle.push_back(name.first + k);
    message.obstacle_count = static_cast<std::int32_t>(message.obstacle.size());
  }
  return messages;
}

template <int Dim>
void set_happened(const Frame<Dim>& frame, double dt, talus_event& message) {
  message.happened_step = frame.step;
  message.happened_time = std::max(0.0, frame.time - dt);
}

std::string_view range_fault(const talus_event& m) {
  if (!header_holds(m)) return "header out of range";
  if (m.number < 0 || m.number >= m.total) return "number out of range";
  if (m.happened_step < -1 || !(m.happened_time >= 0.0 || m.happened_time == -1.0)) return "time out of range";
  if (std::any_of(m.obstacle.begin(), m.obstacle.end(), is_negative)) return "negative obstacle";
  return {};
}

template std::vector<talus_event> to_events(const Scene<2>&);
template std::vector<talus_event> to_events(const Scene<3>&);
template void set_happened(const Frame<2>&, double, talus_event&);
template void set_happened(const Frame<3>&, double, talus_event&);

}  // namespace talus

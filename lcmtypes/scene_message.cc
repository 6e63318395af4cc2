#include "lcmtypes/scene_message.h"

#include <algorithm>

#include "lcmtypes/message.h"

namespace talus {

using talus_lcm::talus_scene;

template <int Dim>
std::vector<talus_scene> to_scene_files(const Scene<Dim>& scene) {
  constexpr std::size_t part_bytes = 48'000;
  std::vector<talus_scene> messages;
  for (const SceneFile& file : scene_files(scene)) {
    const std::size_t parts = std::max<std::size_t>(1, (file.text.size() + part_bytes - 1) / part_bytes);
    for (std::size_t part = 0; part < parts; ++part) {
      talus_scene& message = messages.emplace_back();
      message.file = file.name;
      message.part = static_cast<std::int32_t>(part);
      message.parts = static_cast<std::int32_t>(parts);
      message.text = file.text.substr(part * part_bytes, part_bytes);
    }
  }
  return messages;
}
template std::vector<talus_scene> to_scene_files(const Scene<2>&);
template std::vector<talus_scene> to_scene_files(const Scene<3>&);

void SceneFilesReader::take(const talus_scene& message) {
  if (message.part != next_part_) {
    whole_ = false;
    return;
  }
  if (message.part == 0) files_.push_back({message.file, ""});
  whole_ = whole_ && message.file == files_.back().name;
  files_.back().text += message.text;
  next_part_ = message.part + 1 < message.parts ? message.part + 1 : 0;
}

std::string_view range_fault(const talus_scene& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  return {};
}

}  // namespace talus

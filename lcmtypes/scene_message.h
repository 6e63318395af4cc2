#pragma once
// talus_scene: the files of a scene.

#include <string_view>
#include <vector>

#include "common/scene/write_scene.h"
#include "lcmtypes/channels.h"

namespace talus {

/// The files of a scene that was read from TOML, in parts; none of another. Throws std::system_error where one cannot
/// be read.
template <int Dim>
std::vector<talus_lcm::talus_scene> to_scene_files(const Scene<Dim>& scene);

/// Puts the files of a scene together from their parts.
class SceneFilesReader {
 public:
  void take(const talus_lcm::talus_scene& message);

  /// Empty where a part is missing.
  std::vector<SceneFile> files() const { return whole_ && next_part_ == 0 ? files_ : std::vector<SceneFile>(); }

 private:
  std::vector<SceneFile> files_;
  std::int32_t next_part_ = 0;
  bool whole_ = true;
};

/// The first value that is out of its range, or nothing (see decode()).
std::string_view range_fault(const talus_lcm::talus_scene& message);

}  // namespace talus

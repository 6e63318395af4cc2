#include "common/scene/write_scene.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "common/math/require.h"
#include "common/text/file.h"

namespace talus {

namespace fs = std::filesystem;

template <int Dim>
std::vector<SceneFile> scene_files(const Scene<Dim>& scene) {
  if (scene.toml.empty()) return {};
  std::vector<SceneFile> files = {{scene_file_name, scene.toml}};
  for (const fs::path& referred : scene.referred) {
    const fs::path file = scene.folder / referred;
    const bool named_before = std::ranges::find(files, referred.string(), &SceneFile::name) != files.end();
    if (named_before || !fs::exists(file)) continue;  // in 2D a mesh may lack its parts, which are not used
    std::optional<std::string> text = file_contents(file);
    require(text.has_value(), "file of the scene", file.string(), readable_rule);
    files.push_back({referred.string(), std::move(*text)});
  }
  return files;
}

void write_scene_files(const std::vector<SceneFile>& files, const fs::path& folder) {
  for (const SceneFile& each : files) {
    const fs::path name = each.name;
    const bool below = name.is_relative() && name.has_filename() && std::ranges::find(name, "..") == name.end();
    require(below, "file of the scene", each.name, "must be in or below the scene's folder");
    const fs::path file = folder / name;
    fs::create_directories(file.parent_path());
    write_file(file, each.text);
  }
}

template std::vector<SceneFile> scene_files(const Scene<2>&);
template std::vector<SceneFile> scene_files(const Scene<3>&);

}  // namespace talus

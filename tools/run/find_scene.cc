#include "tools/run/find_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "common/text/nearest_name.h"
#include "tools/run/data_folder.h"

namespace talus {
namespace fs = std::filesystem;

fs::path scene_folder() { return data_folder("scenes"); }

std::vector<fs::path> scene_files(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

fs::path find_scene(const std::string& scene, const fs::path& folder) {
  std::error_code error;
  const fs::file_type type = fs::status(scene, error).type();
  if (type == fs::file_type::regular) return scene;
  if (type == fs::file_type::none)  // its folder cannot be read, its name is too long, ...
    throw std::invalid_argument(fmt::format("scene = {}: {}", scene, error.message()));
  std::vector<std::string> names;
  for (const fs::path& file : scene_files(folder)) {
    if (file.stem() == scene) return file;
    names.push_back(file.stem());
  }
  fs::path below = folder / (scene + ".toml");  // as public/hopper_2d
  if (fs::is_regular_file(below, error)) return below;
  const std::string nearest = nearest_name(scene, names);
  throw std::invalid_argument(fmt::format("scene = {}: must be a file or the name of a scene that `talus list` shows{}",
                                          scene,
                                          nearest.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", nearest)));
}

}  // namespace talus

#include "common/scene/write_scene.h"

#include <fstream>
#include <stdexcept>

namespace talus {
namespace {

namespace fs = std::filesystem;

// A scene in 2D may lack the parts of a mesh, since it does not use them.
void copy_referred(const fs::path& from, const fs::path& to) {
  std::error_code same_or_missing;
  if (fs::exists(from) && !fs::equivalent(from, to, same_or_missing)) {
    fs::create_directories(to.parent_path());
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  }
}

}  // namespace

template <int Dim>
void write_scene(const Scene<Dim>& scene, const std::filesystem::path& file) {
  if (scene.toml.empty())
    throw std::invalid_argument("scene.toml is empty: only a scene that was read from TOML can be written");
  std::ofstream stream(file, std::ios::binary);
  stream << scene.toml;
  stream.close();
  if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
  for (const fs::path& referred : scene.referred) copy_referred(scene.folder / referred, file.parent_path() / referred);
}

template void write_scene(const Scene<2>&, const std::filesystem::path&);
template void write_scene(const Scene<3>&, const std::filesystem::path&);

}  // namespace talus

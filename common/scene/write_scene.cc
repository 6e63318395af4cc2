#include "common/scene/write_scene.h"

#include <fstream>
#include <stdexcept>

namespace talus {

template <int Dim>
void write_scene(const Scene<Dim>& scene, const std::filesystem::path& file) {
  if (scene.toml.empty()) {
    throw std::invalid_argument("scene.toml is empty: only a scene that was read from TOML can be written");
  }
  std::ofstream stream(file, std::ios::binary);
  stream << scene.toml;
  stream.close();
  if (!stream) {
    throw std::runtime_error(file.string() + ": cannot be written");
  }
}

template void write_scene(const Scene<2>&, const std::filesystem::path&);
template void write_scene(const Scene<3>&, const std::filesystem::path&);

}  // namespace talus

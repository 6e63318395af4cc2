#include "tools/run/data_folder.h"

namespace talus {
namespace fs = std::filesystem;

fs::path data_folder(const fs::path& name) {
  return fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "share/talus" / name;
}

}  // namespace talus

#include "tools/run/data_folder.h"

namespace talus {
namespace fs = std::filesystem;

fs::path data_folder(const fs::path& name, const fs::path& in_source) {
  std::error_code unknown;
  const fs::path command = fs::read_symlink("/proc/self/exe", unknown);
  const fs::path installed = command.parent_path().parent_path() / "share/talus" / name;
  return !unknown && fs::is_directory(installed, unknown) ? installed : TALUS_SOURCE_FOLDER / in_source;
}

}  // namespace talus

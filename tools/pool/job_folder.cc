#include "tools/pool/job_folder.h"

#include <fmt/format.h>

#include "tools/pool/folder_lock.h"

namespace talus {

std::invalid_argument other_job(const std::filesystem::path& folder, std::string_view job) {
  return std::invalid_argument(fmt::format("--out {}: must be new, empty, or of {}", folder.string(), job));
}

void make_job_folder(const std::filesystem::path& folder, std::string_view own, std::string_view job) {
  if (!std::filesystem::exists(folder / own) && !is_new_folder(folder)) throw other_job(folder, job);
  std::filesystem::create_directories(folder);
}

}  // namespace talus

#include "tools/pool/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace talus {

namespace fs = std::filesystem;

bool is_new_folder(const fs::path& folder) {
  if (!fs::exists(folder)) return true;
  return fs::is_directory(folder) && std::ranges::all_of(fs::directory_iterator(folder), [](const auto& entry) {
           return entry.path().filename() == lock_file;
         });
}

FolderLock::FolderLock(const fs::path& folder, Kind kind)
    : file_(open((folder / lock_file).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (file_ < 0) throw std::system_error(errno, std::generic_category(), (folder / lock_file).string());
  if (flock(file_, (kind == Kind::whole ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(file_);
  throw std::invalid_argument(
      fmt::format("{}: another command is at work in this folder; start again once it has ended", folder.string()));
}

FolderLock::~FolderLock() { close(file_); }

}  // namespace talus

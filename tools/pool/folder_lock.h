#pragma once

#include <filesystem>

namespace talus {

/// The file by which a folder is locked, in that folder.
inline constexpr const char* lock_file = "lock";

/// Whether the folder does not exist, or holds at most a lock.
bool is_new_folder(const std::filesystem::path& folder);

/// Keeps other commands out of a folder as long as it lives, in processes of other machines too where the file system
/// has locks. One task alone shares the folder with others of its kind.
class FolderLock {
 public:
  enum class Kind { whole, one_task };
  /// Throws std::invalid_argument where another command is at work.
  FolderLock(const std::filesystem::path& folder, Kind kind);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace talus

#pragma once
// Whole files.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace talus {

/// What is required of a file that is read.
inline constexpr const char* readable_rule = "must be a regular file that can be read";

/// All bytes of a file; none where it cannot be read or is no regular file, but a folder, a pipe or a device.
std::optional<std::string> file_contents(const std::filesystem::path& file);

/// A name beside `file`, with its ending, that nothing has, for what is not complete yet.
std::filesystem::path unfinished_name(const std::filesystem::path& file);

/// A file on its way: it is written under another name and takes its own when it is complete, so that a failure leaves
/// an older file as it is. What is there and no regular file, as a device, is written itself.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::filesystem::path& file);
  /// Removes what is not finished.
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  /// Where to write.
  const std::filesystem::path& path() const { return path_; }
  /// Puts it in its place. Throws std::filesystem::filesystem_error where that fails.
  void finish();

 private:
  std::filesystem::path file_;  // what links lead to
  std::filesystem::path path_;
};

/// Makes the file or replaces it, as a whole or not at all. Throws std::runtime_error with its name where it cannot be
/// written.
void write_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace talus

#include "common/text/file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace talus {

std::optional<std::string> file_contents(const std::filesystem::path& file) {
  std::error_code unused;
  if (!std::filesystem::is_regular_file(file, unused)) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.bad() ? std::nullopt : std::optional(std::move(bytes).str());
}

std::filesystem::path unfinished_name(const std::filesystem::path& file) {
  // Numbers of processes may be the same on two machines that share a disk.
  const std::string name = file.stem().string() + ".unfinished-" + std::to_string(std::random_device()());
  return file.parent_path() / (name + file.extension().string());
}

UnfinishedFile::UnfinishedFile(const std::filesystem::path& file) : file_(file), path_(file) {
  std::error_code unused;
  if (std::filesystem::is_regular_file(file, unused)) file_ = std::filesystem::canonical(file);
  const bool is_regular = std::filesystem::is_regular_file(file_, unused);
  if (is_regular || !std::filesystem::exists(std::filesystem::symlink_status(file_, unused)))
    path_ = unfinished_name(file_);
}

UnfinishedFile::~UnfinishedFile() {
  std::error_code unused;
  if (path_ != file_) std::filesystem::remove(path_, unused);
}

void UnfinishedFile::finish() {
  if (path_ != file_) std::filesystem::rename(path_, file_);
  path_ = file_;
}

void write_file(const std::filesystem::path& file, std::string_view bytes) {
  UnfinishedFile unfinished(file);
  errno = 0;
  std::ofstream out(unfinished.path(), std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(errno));
  unfinished.finish();
}

}  // namespace talus

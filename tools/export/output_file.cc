#include "tools/export/output_file.h"

#include <cerrno>
#include <system_error>

namespace talus {

OutputFile::OutputFile(const std::filesystem::path& path)
    : path_(path), unfinished_(path), out_(unfinished_.path(), std::ios::binary) {
  check();
}

void OutputFile::write(std::string_view bytes) {
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  check();
}

void OutputFile::write_at(std::uint64_t offset, std::string_view bytes) {
  out_.seekp(static_cast<std::streamoff>(offset));
  write(bytes);
}

void OutputFile::close() {
  out_.close();
  check();
  unfinished_.finish();
}

void OutputFile::check() {
  if (!out_) throw std::system_error(errno, std::generic_category(), path_.string());
}

}  // namespace talus

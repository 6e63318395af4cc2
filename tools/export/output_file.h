#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "common/text/file.h"

namespace talus {

/// A file being written, which replaces one that is there when it is closed. Each call throws std::system_error with
/// the path where the disk is full or the file cannot be made.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  void write(std::string_view bytes);
  /// Over what is there, `offset` bytes from the beginning.
  void write_at(std::uint64_t offset, std::string_view bytes);
  void close();

 private:
  void check();

  std::filesystem::path path_;
  UnfinishedFile unfinished_;
  std::ofstream out_;
};

/// Appends the bytes of a number, lowest first.
template <class Number>
void append_bytes(std::string& bytes, Number number) {
  static_assert(std::endian::native == std::endian::little);
  char raw[sizeof(Number)];
  std::memcpy(raw, &number, sizeof(Number));
  bytes.append(raw, sizeof(Number));
}

}  // namespace talus

#pragma once
// Arrays of NumPy in one file: a ZIP archive without compression whose members are .npy files.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tools/export/output_file.h"

namespace talus {

/// Declared arrays get their place in the file at once, and their bytes afterwards, in turns. Any size (ZIP64).
class NpzFile {
 public:
  explicit NpzFile(const std::filesystem::path& path) : out_(path) {}

  /// Adds an array of so many rows in C order. `type` is of NumPy: "<f4" or
  /// "|i1" or "|S20". Returns its number.
  int declare(std::string_view name, std::string_view type, const std::vector<std::uint64_t>& shape);

  /// The next bytes of an array.
  void append(int array, std::string_view bytes);

  /// Writes what remains. Aborts where an array has fewer or more bytes than declared.
  void finish();

 private:
  struct Member {
    std::string name;
    std::string header;        // of the .npy file
    std::uint64_t size = 0;    // bytes of the member, header included
    std::uint64_t offset = 0;  // of its ZIP header
    std::uint64_t written = 0;
    std::uint32_t crc = 0;
  };
  static std::string local_header(const Member& member);

  OutputFile out_;
  std::uint64_t end_ = 0;
  std::vector<Member> members_;
};

}  // namespace talus

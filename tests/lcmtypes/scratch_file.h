#pragma once

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/common/temporary_folder.h"

namespace talus {

/// A file of its own for one test, gone afterwards.
class ScratchFile {
 public:
  std::string path() const { return folder_ / "file"; }

  std::vector<std::uint8_t> read() const {
    std::ifstream file(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const std::vector<std::uint8_t>& bytes) const {
    std::ofstream file(path(), std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace talus

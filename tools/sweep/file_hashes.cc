#include "tools/sweep/file_hashes.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <vector>

#include "common/math/hash.h"
#include "common/text/file.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// Empty where there is no such file: a scene may do without, as in 2D without the parts of a mesh.
std::string hash_of(const fs::path& file) {
  const std::optional<std::string> text = file_contents(file);
  if (!text) return "";
  Fnv1a hash;
  hash.add(*text);
  return fmt::format("{:016x}", hash.value());
}

/// All files of a scene, relative to its folder.
std::vector<fs::path> files_of(const fs::path& file, const AnyScene& scene) {
  return std::visit(
      [&](const auto& of_dimension) {
        std::vector<fs::path> files = of_dimension.referred;
        files.push_back(file.filename());
        for (const fs::path& included : of_dimension.included)
          files.push_back(included.lexically_relative(file.parent_path()));
        return files;
      },
      scene);
}

}  // namespace

void add_file_hashes(FileHashes& hashes, const fs::path& file, const AnyScene& scene) {
  for (const fs::path& each : files_of(file, scene))
    if (!hashes.contains(each.string())) hashes[each.string()] = hash_of(file.parent_path() / each);
}

void require_unchanged(const FileHashes& hashes, const fs::path& file, std::string_view began) {
  for (const auto& [name, hash] : hashes)
    if (const fs::path each = file.parent_path() / name; hash_of(each) != hash)
      throw std::invalid_argument(fmt::format("{}: must be as it was when {} began", each.string(), began));
}

}  // namespace talus

// Input: a byte that chooses the dimension, then messages of a record, each a byte for its type, two for its length and
// as many between fingerprint and checksum. They are written as the run.lcm of a run folder, which is read back.
#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "tests/common/temporary_folder.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/limits.h"
#include "tests/fuzz/sealed_message.h"
#include "tools/record/recorded_run.h"

namespace {

using namespace talus;

// The scenes that the recorded runs claim to be of: two shapes, 20 bodies.
constexpr std::string_view scene_2d = R"(title = "recorded"
dimension = 2
[shape.a]
kind = "box"
size = [0.5, 0.5]
[shape.b]
kind = "ball"
radius = 0.5
[[source]]
shape = ["a", "b"]
position = [0, 5]
count = 20
rate = 1
[run]
frames = 30
)";
constexpr std::string_view scene_3d = R"(title = "recorded"
dimension = 3
[shape.a]
kind = "box"
size = [0.5, 0.5, 0.5]
[shape.b]
kind = "ball"
radius = 0.5
[[source]]
shape = ["a", "b"]
position = [0, 0, 5]
count = 20
rate = 1
[run]
frames = 30
)";

void write_number(std::ostream& out, std::uint64_t value, int size) {
  for (int i = size - 1; i >= 0; --i) out.put(static_cast<char>(value >> (8 * i) & 0xFFU));
}

void write_event(std::ostream& out, std::uint64_t number, Channel channel, std::span<const std::uint8_t> message) {
  const std::string_view name = name_of(channel);
  write_number(out, 0xEDA1DA01, 4);
  write_number(out, number, 8);
  write_number(out, number, 8);
  write_number(out, name.size(), 4);
  write_number(out, message.size(), 4);
  out << name << fuzz::text(message);
}

void write_log(const std::filesystem::path& file, std::span<const std::uint8_t> input) {
  std::ofstream out(file, std::ios::binary);
  for (std::uint64_t number = 0; input.size() >= 3; ++number) {
    const auto channel = static_cast<Channel>(input[0] % channel_names.size());
    const auto wanted = static_cast<std::size_t>(input[1] << 8 | input[2]);
    const auto content = input.subspan(3, std::min(wanted, input.size() - 3));
    write_event(out, number, channel, fuzz::sealed_message(channel, content));
    input = input.subspan(3 + content.size());
  }
}

void read_back(const std::filesystem::path& folder) {
  const fuzz::TimeLimit limit;
  try {
    (void)read_run(folder);
  } catch (const std::invalid_argument& error) {
    fuzz::require_that(*error.what() != '\0', "a refused record has a reason");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const TemporaryFolder folder;
  std::ofstream(folder / "scene.toml") << (data[0] % 2 == 0 ? scene_2d : scene_3d);
  write_log(folder / "run.lcm", std::span(data, size).subspan(1));
  read_back(folder.path());
  return 0;
}

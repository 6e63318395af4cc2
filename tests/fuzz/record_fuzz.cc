// Input: a byte that chooses the dimension, then messages of a record, each a byte for its type, two for its length and
// as many between fingerprint and checksum. They are written as a record, which is read back.
#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

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

std::unique_ptr<std::istream> log_of(std::span<const std::uint8_t> input) {
  auto log = std::make_unique<std::stringstream>();
  for (std::uint64_t number = 0; input.size() >= 3; ++number) {
    const auto channel = static_cast<Channel>(input[0] % channel_names.size());
    const auto wanted = static_cast<std::size_t>(input[1] << 8 | input[2]);
    const auto content = input.subspan(3, std::min(wanted, input.size() - 3));
    write_event(*log, number, channel, fuzz::sealed_message(channel, content));
    input = input.subspan(3 + content.size());
  }
  return log;
}

void read_back(const AnyScene& scene, std::unique_ptr<std::istream> log) {
  const fuzz::TimeLimit limit;
  try {
    LogReader reader(std::move(log));
    (void)read_record(scene, reader, "run");
  } catch (const std::invalid_argument& error) {
    fuzz::require_that(*error.what() != '\0', "a refused record has a reason");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const std::array scenes = {parse_scene(scene_2d, "scene.toml"), parse_scene(scene_3d, "scene.toml")};
  const std::span input(data, size);
  read_back(scenes[input[0] % scenes.size()], log_of(input.subspan(1)));
  return 0;
}

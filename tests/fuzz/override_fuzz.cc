// Input: arguments of `--set`, one a line.
#include <vector>

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/read_as_scene.h"

namespace {

// One table of each kind, so that every path leads somewhere.
constexpr std::string_view scene = R"(
title = "overridden"
dimension = 2
[world]
gravity = 9.81
[[obstacle]]
kind = "box"
size = [1, 1]
position = [5, 0.5]
[shape.x]
kind = "box"
size = [0.5, 0.5]
[[source]]
shape = "x"
position = [0, 5]
count = 10
rate = 1
[[pile]]
alpha_deg = 30
[policy]
kind = "adaptive"
[run]
frames = 30
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<talus::Override> overrides(1);
  const std::string_view input = talus::fuzz::text({data, size});
  for (const char letter : input)
    if (letter == '\n')
      overrides.emplace_back();
    else
      overrides.back().text += letter;
  talus::fuzz::read_as_scene(input, scene, overrides);
  return 0;
}

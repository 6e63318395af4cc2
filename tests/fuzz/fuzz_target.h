#pragma once
// The function that a fuzz target defines, and what targets share.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

/// Runs one input through the target. libFuzzer calls it, and so does replay.cc. Returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace talus::fuzz {

/// The input as text.
inline std::string_view text(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Whether the costly part of a target is due for this input: always in a replay, for one input in eight in a search,
/// chosen by the input's hash so that it is the same each time.
bool costly_part_is_due(std::string_view input);

}  // namespace talus::fuzz

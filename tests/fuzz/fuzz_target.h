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

}  // namespace talus::fuzz

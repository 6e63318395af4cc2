#pragma once

#include <string>
#include <string_view>

namespace talus {

/// Of two blocks of one FrameEncoder (frame_stream.h) that follow each other, one block that brings a page from the
/// state before both to the state after both. It has the events of both, of each body in their order.
template <int Dim>
std::string merge_blocks(std::string_view first, std::string_view second);

}  // namespace talus

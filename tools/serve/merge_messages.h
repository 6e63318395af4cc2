#pragma once

#include <string>
#include <string_view>

namespace talus {

/// Of the log events of two moments of a run that follow each other, those that bring a page from before both to after
/// both: what happened in both, piles, numbers and obstacles of the second, and the poses of all bodies that either
/// names, the newer ones where both do.
std::string merge_messages(std::string_view first, std::string_view second);

}  // namespace talus

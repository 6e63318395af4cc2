#pragma once

#include <string>
#include <vector>

#include "tools/picture/canvas.h"

namespace talus {

/// Text broken between words into lines of at most `width` [px], and at each '\n'. A longer word stays whole.
std::vector<std::string> wrapped(const std::string& text, double width, const TextStyle& style);

}  // namespace talus

#pragma once

#include <string>
#include <string_view>

namespace talus {

/// Bytes as text of letters, digits, `+` and `/`, padded by `=` (RFC 4648, section 4).
std::string base64(std::string_view bytes);

}  // namespace talus

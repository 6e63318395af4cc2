#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace talus {

/// JSON in ASCII: a terminal shows it without harm. In strings from records and from the network, what is not UTF-8 is
/// replaced by U+FFFD. `indent` < 0: one line.
inline std::string json_text(const nlohmann::ordered_json& json, int indent = -1) {
  return json.dump(indent, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace talus

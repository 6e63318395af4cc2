#pragma once

#include <nlohmann/json.hpp>

namespace talus {

/// What the browser page has before any message: {"format", "version" of talus, "channels": {name: {"fingerprint" in
/// hexadecimal, "fields": [{"name", "type" of the LCM language, "count": number, or name of the field with it}]}},
/// "causes" of sleep by number, "colours" and "camera" of the pictures}. A type "message" has "fields" of its own.
nlohmann::ordered_json page_settings();

}  // namespace talus

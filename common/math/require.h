#pragma once
// How a bad value is refused at the door.

#include <string>
#include <string_view>

namespace talus {

/// Throws std::invalid_argument "FIELD = VALUE: RULE" unless `holds`. A rule is written as "must be ...".
void require(bool holds, std::string_view field, double value, std::string_view rule);
void require(bool holds, std::string_view field, const std::string& value, std::string_view rule);

}  // namespace talus

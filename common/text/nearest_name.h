#pragma once

#include <span>
#include <string>
#include <string_view>

namespace talus {

/// How many letters must be changed, added, left out or swapped with their neighbour to turn one name into the other;
/// upper and lower case count as one.
int edit_distance(std::string_view a, std::string_view b);

/// The known name that was most likely meant, or empty if none is near: at most a third of the letters differ, or one
/// is part of the other.
std::string nearest_name(std::string_view name, std::span<const std::string> known);

}  // namespace talus

#pragma once

#include <string>
#include <vector>

namespace talus {

/// A line of a CSV file with its end: cells with a comma, a quote or a line end are quoted.
std::string csv_line(const std::vector<std::string>& cells);

}  // namespace talus

#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace talus {

/// Which messages of a log are wanted.
struct MessageChoice {
  std::vector<std::string> channels;  // empty: all
  /// [s] after the first stamp of the log; in a record the simulated time. Stamps of a damaged record may be earlier.
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

/// Prints the chosen messages of an event log, a JSON object a line; `message` is null where talus cannot decode it.
void print_messages(const std::filesystem::path& file, const MessageChoice& choice);

}  // namespace talus

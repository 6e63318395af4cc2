#pragma once
// The browser page of tools/view/page, and what it reads.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/setting_differences.h"

namespace talus {

/// The page as one file that opens from a disk and plays the record of a run, an LCM event log, of that name. Throws
/// std::system_error with the name of a file of the built page that cannot be read.
std::string page_with(std::string_view log, const std::string& name);

/// Texts for a page that shows two others side by side.
struct PairTexts {
  bool of_runs = false;                             // of scenes that are simulated; else of records
  std::array<double, 2> ms_per_step = {0, 0};       // of records: mean wall time; 0: not known
  std::vector<SettingDifference> differences = {};  // of the two scenes
};

/// The page with two pages of the server, at a/ and b/, which it plays in step.
std::string page_of_pair(const PairTexts& texts);

/// The page as the server sends it: it is sent a run over a WebSocket, or fetches a record.
std::string page_of_run();
std::string page_of_record(const std::string& name);

}  // namespace talus

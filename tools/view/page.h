#pragma once
// The browser page of tools/view/page, and what it reads.

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/setting_differences.h"

namespace talus {

/// Head (run_head.h) and blocks (frame_stream.h) as a zlib stream: the head's size (four bytes, low byte first), the
/// head, the blocks.
std::string stream_bytes(const nlohmann::ordered_json& head, std::string_view blocks);

/// The page as one file that opens from a disk and plays `stream`. Throws std::system_error with the name of a file of
/// the built page that cannot be read.
std::string page_with(std::string_view stream);

/// What a page of the server shows.
enum class PageSource { record, run };

/// Texts for a page that shows two others side by side.
struct PairTexts {
  bool of_runs = false;                             // of scenes that are simulated; else of records
  std::array<double, 2> ms_per_step = {0, 0};       // of records: mean wall time; 0: not known
  std::vector<SettingDifference> differences = {};  // of the two scenes
};

/// The page with two pages of the server, at a/ and b/, which it plays in step.
std::string page_of_pair(const PairTexts& texts);

/// The page as the server sends it: it fetches what it shows.
std::string page_of_server(PageSource source);

}  // namespace talus

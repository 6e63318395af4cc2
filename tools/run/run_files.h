#pragma once
// What the files of a run folder are called, apart from the scene's and the pictures of events.

#include <array>

namespace talus::run_files {

inline constexpr const char* record = "run.lcm";
inline constexpr const char* summary = "summary.json";
inline constexpr const char* frames = "frames.csv";
inline constexpr const char* gates = "gates.csv";
inline constexpr const char* regions = "regions.csv";
inline constexpr const char* loads = "loads.csv";
inline constexpr const char* profiles = "profiles.csv";
inline constexpr const char* drawing = "pile.svg";
inline constexpr const char* picture = "pile.png";

inline constexpr std::array all = {record, summary, frames, gates, regions, loads, profiles, drawing, picture};

}  // namespace talus::run_files

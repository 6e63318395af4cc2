#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// Options of `talus bench truth`. 0 and empty: the default that truth_command.cc states.
struct TruthOptions {
  /// Names or parts of names.
  std::vector<std::string> cells;
  /// Scene files, folders of them and names of scenes; empty: the cells.
  std::vector<std::string> scenes;
  std::vector<std::string> backends;
  /// path=value, for adaptive.
  std::vector<std::string> settings;
  std::filesystem::path out;
  /// Seed of the covering design.
  std::int64_t design = 1;
  int count = 0;
  int seeds = 0;
  int bodies = 0;
  int jobs = 2;
  bool quick = false;
};

/// Measures the rows that are missing, writes report.html, results.md, results.csv and results.json, and prints the
/// table, worst cells first. Throws std::invalid_argument where --cells fits no cell or --scenes no scene.
void bench_truth(const TruthOptions& options);

}  // namespace talus

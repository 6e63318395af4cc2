#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/bench/bench_results.h"
#include "tools/bench/truth_result.h"

namespace talus {

/// A cell on one engine, measured.
struct TruthRow {
  TruthRuns runs;
  TruthResult result;
};

/// Writes the pages, results.csv and results.json into `folder`, and prints the table. `results` holds what the head of
/// the pages shows; tables and pictures are added. Pictures of red cells are those of picture_file() that exist.
void report_truth(const std::filesystem::path& folder, std::vector<TruthRow> rows, BenchResults results);

/// PNG of the first seed's last state.
std::filesystem::path picture_file(const std::filesystem::path& folder, const std::string& cell,
                                   const std::string& backend, const std::string& policy);

}  // namespace talus

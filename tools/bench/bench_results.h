#pragma once
// What a benchmark leaves in its folder: results.csv, results.json, results.md, report.html and its figures.

#include <filesystem>
#include <string>
#include <vector>

#include "tools/bench/bench_runner.h"
#include "tools/report/html_report.h"

namespace talus {

struct BenchResults {
  std::string title;
  /// What was run and how to read it, a paragraph each.
  std::vector<std::string> notes;
  /// Tables and figures.
  std::vector<Section> sections;
  /// Measures the same again, for the head of the page; write_results() fills it in. Empty: not printed.
  std::string command = {};
};

/// Writes the files, and with options.docs NAME.md with its figures there. CSV and JSON hold the summary of every case
/// of `groups`.
void write_results(const BenchRunner& runner, const std::vector<BenchGroup>& groups, const BenchResults& results);

/// The pages alone, report.html and results.md with its figures, in `folder`.
void write_pages(const std::filesystem::path& folder, const BenchResults& results);

/// NAME.md in `folder`, and its figures as NAME-1.svg, NAME-2.svg, ...
void write_page(const std::filesystem::path& folder, const std::string& name, const BenchResults& results);

}  // namespace talus

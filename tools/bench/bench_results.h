#pragma once
// What a benchmark leaves: results.csv, results.json, results.md, report.html and its
// figures in its folder.

#include <string>
#include <vector>

#include "tools/bench/bench_runner.h"
#include "tools/report/html_report.h"

namespace talus {

struct BenchResults {
  std::string title;
  std::vector<std::string> notes;  // what was run and how to read it, a paragraph each
  std::vector<Section> sections;   // tables and figures
};

/// Writes the files; the CSV and the JSON hold the summary of every case of `groups`.
void write_results(const BenchRunner& runner, const std::vector<BenchGroup>& groups, const BenchResults& results);

/// Tables that every benchmark shows of its groups: times and what they bring; errors of motion; shape; last state.
std::vector<Section> common_sections(const BenchRunner& runner, const std::vector<BenchGroup>& groups);

/// A number for a table, "-" for what was not measured.
std::string shown(double value, int digits = 3);

/// "1.37 (1.35-1.68)".
std::string shown_with_range(const Values& values, const std::string& name, int digits = 3);

/// How a case's policy is called in tables: with those of its settings that not all cases of its group have.
std::string label_of(const BenchGroup& group, const BenchCase& bench_case);

}  // namespace talus

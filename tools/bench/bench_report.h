#pragma once
// A benchmark as a row: its scenes, its cases, its columns, its plots.

#include <functional>
#include <string>
#include <vector>

#include "tools/bench/case_plot.h"
#include "tools/bench/case_table.h"

namespace talus {

struct BenchReport {
  std::string title;
  /// What was run and how to read it.
  std::string note;
  /// Scene names without dimension; with --quick the first `quick_scenes` of them.
  std::vector<std::string> scenes;
  std::size_t quick_scenes = 1;
  /// The groups of one scene on one engine.
  std::function<std::vector<BenchGroup>(const BenchOptions&, const std::string& scene, const std::string& backend)>
      groups;
  /// Its own table, which is also printed at the end, and which cases it shows (none given: all).
  std::vector<CaseColumn> columns;
  std::function<bool(const CaseView&)> in_table = {};
  std::vector<CasePlot> plots;
};

/// Measures what is missing and writes the results.
void run_report(const BenchReport& report, const BenchOptions& options);

/// Tables that every benchmark of cases shows: times; errors of motion, shape and last state against each baseline.
std::vector<Section> common_sections(const BenchRunner& runner, const std::vector<BenchGroup>& groups);

}  // namespace talus

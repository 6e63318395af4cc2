#include "tools/bench/case_table.h"

#include <algorithm>

namespace talus {
namespace {

/// The policy, with those of the case's settings that not all cases of its group have.
std::string label_of(const CaseView& view) {
  std::string label = view.bench_case.policy;
  for (const std::string& setting : view.bench_case.settings) {
    const bool everywhere = std::ranges::all_of(view.group.cases, [&](const BenchCase& other) {
      return std::ranges::find(other.settings, setting) != other.settings.end();
    });
    if (!everywhere) label += " " + setting;
  }
  return label;
}

/// The heading of a measure with that of its companion.
std::string heading_with(MeasureId id, const std::string& companion) {
  return std::string(id.info().heading) + companion;
}

}  // namespace

CaseView view_of(const BenchRunner& runner, const BenchGroup& group, const BenchCase& bench_case, Pass pass) {
  return {runner, group, bench_case, runner.summary(bench_case, group.full(), pass)};
}

CaseColumn plain(MeasureId id) {
  return {heading_with(id, ""), [=](const CaseView& view) { return shown(view.values, id); }};
}

CaseColumn with_range(MeasureId id) {
  return {heading_with(id, ""), [=](const CaseView& view) { return shown_with_range(view.values, id); }};
}

CaseColumn with_deviation(MeasureId id) {
  return {heading_with(id, ""), [=](const CaseView& view) { return shown_with_deviation(view.values, id); }};
}

CaseColumn with_floor(MeasureId id) {
  return {heading_with(id, " / floor"), [=](const CaseView& view) { return shown_with_floor(view.values, id); }};
}

std::vector<CaseColumn> name_columns() {
  return {{"scene", [](const CaseView& view) { return key_of(view.bench_case).scene; }, false},
          {"engine", [](const CaseView& view) { return view.bench_case.backend; }, false},
          {"policy", label_of, false}};
}

CaseColumn hindsight_column() {
  const MeasureId id = "hindsight_005";
  return {heading_with(id, ""), [=](const CaseView& view) { return shown(view.of(view.group.full()), id); }};
}

bool sleeps(const CaseView& view) { return view.bench_case.policy != "full" && !is_baseline(view.bench_case); }

Table case_table(const BenchRunner& runner, const std::vector<BenchGroup>& groups,
                 const std::vector<CaseColumn>& columns, Pass pass,
                 const std::function<bool(const CaseView&)>& wanted) {
  Table table;
  for (const CaseColumn& column : columns) table.columns.push_back({column.heading, column.number});
  for (const BenchGroup& group : groups) {
    for (const BenchCase& each : group.cases) {
      const CaseView view = view_of(runner, group, each, pass);
      if (view.values.empty() || (wanted && !wanted(view))) continue;
      std::vector<std::string> row;
      for (const CaseColumn& column : columns) row.push_back(column.cell(view));
      table.rows.push_back(row);
    }
  }
  return table;
}

}  // namespace talus

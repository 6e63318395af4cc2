#pragma once
// Tables of cases: a row a case, a column a measure.

#include <functional>
#include <string>
#include <vector>

#include "tools/bench/bench_runner.h"
#include "tools/report/table.h"

namespace talus {

/// One case as tables and plots see it.
struct CaseView {
  const BenchRunner& runner;
  const BenchGroup& group;
  const BenchCase& bench_case;
  /// Its measures against the baseline of the table.
  Values values;

  /// Measures of another case of the group.
  Values of(const BenchCase& other) const { return runner.summary(other, group.full()); }
};

CaseView view_of(const BenchRunner& runner, const BenchGroup& group, const BenchCase& bench_case,
                 Pass pass = Pass::against_full);

/// A column of a table: its heading and its cell for a case.
struct CaseColumn {
  std::string heading;
  std::function<std::string(const CaseView&)> cell;
  /// Aligned to the right.
  bool number = true;
};

/// Columns of one measure under its own heading: the number alone, with the range of the rounds, with the deviation of
/// one run, with its floor.
CaseColumn plain(MeasureId id);
CaseColumn with_range(MeasureId id);
CaseColumn with_deviation(MeasureId id);
CaseColumn with_floor(MeasureId id);

/// "scene", "engine", "policy" with the settings that differ within the group.
std::vector<CaseColumn> name_columns();

/// Hindsight of the group's full run, which bounds no policy (common/measure/work.h).
CaseColumn hindsight_column();

/// Whether the case is a policy that lets bodies sleep: neither full nor a baseline.
bool sleeps(const CaseView& view);

/// A row per case for which `wanted` is true and something was measured.
Table case_table(const BenchRunner& runner, const std::vector<BenchGroup>& groups,
                 const std::vector<CaseColumn>& columns, Pass pass = Pass::against_full,
                 const std::function<bool(const CaseView&)>& wanted = {});

}  // namespace talus

#pragma once

#include "tools/bench/bench_runner.h"
#include "tools/report/table.h"

namespace talus {

/// What the project wants of a policy, beside what the groups show: a row a target and case of another policy than full
/// and engine. Targets that need a reference are left out where none was measured.
Table targets_table(const BenchRunner& runner, const std::vector<BenchGroup>& groups);

}  // namespace talus

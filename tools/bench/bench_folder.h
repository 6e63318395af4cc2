#pragma once
// The folder of a benchmark: what is run, and the rows measured so far.

#include <filesystem>
#include <vector>

#include "tools/bench/bench_plan.h"
#include "tools/pool/in_processes.h"

namespace talus {

/// Makes the folder of a benchmark. Throws std::invalid_argument where it has anything else.
void make_bench_folder(const std::filesystem::path& folder);

/// Writes bench.json into options.out, where `options` are completed; or finds there the same benchmark, which then
/// goes on. Throws std::invalid_argument where it is another one.
void begin_bench(const BenchOptions& options);

/// The completed options of the benchmark of a folder. Throws std::invalid_argument where it has none.
BenchOptions read_bench(const std::filesystem::path& folder);

/// Keeps what became of a case, in a file of its own that is there whole or not at all.
void keep_outcome(const std::filesystem::path& folder, int number, const TaskOutcome& outcome);

/// One row for each case; those that are not measured have a `failure`, which is `not_measured` where none was tried.
inline constexpr std::string_view not_measured = "not measured yet";
std::vector<BenchRow> kept_rows(const std::filesystem::path& folder, const std::vector<BenchCase>& cases);

}  // namespace talus

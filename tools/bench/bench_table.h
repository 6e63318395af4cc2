#pragma once
// What the runs of a benchmark gave, as files and as a table.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/measure/ensemble.h"
#include "tools/bench/bench_run.h"

namespace talus {

/// Fills in what compares runs: speed_up from the run of full, errors of shape from those of the reference, with the
/// same scene, engine and settings but those of policies.
void compare_rows(std::vector<BenchRow>& rows);

/// One row a run; overwrites the file.
void write_bench_csv(const std::filesystem::path& file, const std::vector<BenchRow>& rows);

/// One row a frame of each run, frames.csv; not written where no row has frames.
void write_frames_csv(const std::filesystem::path& file, const std::vector<BenchRow>& rows);

/// "2.91 ± 0.08"; "-" for what was not measured.
std::string mean_text(const MeanWithError& number);

/// A line for each case, with means over its seeds; columns without any number are left out. `preset` gives the paper's
/// own numbers beside ours; empty: none.
std::string bench_summary(const std::vector<BenchRow>& rows, std::string_view preset);

/// error-SCENE-ENGINE.svg, the time of a run against the error of the centre's height, a curve for each policy; and
/// where rows have frames frame_time-SCENE-ENGINE.svg and frame_error-SCENE-ENGINE.svg. Returns their names.
std::vector<std::string> write_bench_plots(const std::filesystem::path& folder, const std::vector<BenchRow>& rows);

}  // namespace talus

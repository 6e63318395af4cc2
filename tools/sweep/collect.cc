#include "tools/sweep/collect.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>

#include "common/text/printable.h"
#include "tools/output/output.h"
#include "tools/sweep/sweep_table.h"

namespace talus {
namespace {

constexpr int most_told = 20;          // runs that are told of by name
constexpr int progress_rows = 10'000;  // between two lines of progress

/// Tells of a run that failed, or that began and did not end.
void tell_of(const Sweep& sweep, const RunStates& states, int number, RunState state) {
  const std::string messages = states.end_of_messages(number);
  print_message("{} {} {}{}", run_folder(sweep, number).filename().string(),
                fmt::join(settings_of(sweep.axes, sweep_run(sweep.axes, number)), " "),
                state == RunState::failed ? "failed" : "began and has not ended",
                messages.empty() ? "" : ": " + messages);
}

/// Walks through all runs. `row` gets the number and the summary of each that has one. `at_work`: runs that have begun
/// may yet end.
SweepCount walk(const Sweep& sweep, bool at_work, const std::function<void(int, const nlohmann::json&)>& row) {
  const RunStates states(sweep);
  int told = 0;
  SweepCount count{.runs = sweep_size(sweep.axes)};
  for (int i = 0; i < count.runs; ++i) {
    const nlohmann::json summary = summary_of(run_folder(sweep, i));
    if (!summary.empty()) row(i, summary);
    const RunState state = states.of(i, reason_of(summary));
    count.finished += state == RunState::finished ? 1 : 0;
    count.failed += state == RunState::failed ? 1 : 0;
    count.begun += state == RunState::begun ? 1 : 0;
    count.with_warnings += warnings_of(summary) > 0 ? 1 : 0;
    const bool of_note = state == RunState::failed || (state == RunState::begun && !at_work);
    if (of_note && ++told <= most_told) tell_of(sweep, states, i, state);
    if ((i + 1) % progress_rows == 0) print_message("{} of {} runs read", i + 1, count.runs);
  }
  if (told > most_told)
    print_message("and {} more: see the folders failed and at_work of {}", told - most_told, sweep.folder.string());
  return count;
}

}  // namespace

SweepCount count_runs(const Sweep& sweep) {
  return walk(sweep, true, [](int, const nlohmann::json&) {});
}

SweepCount collect(const Sweep& sweep) {
  SweepTable table(sweep.folder / "sweep.csv", sweep.axes, sweep.plot);
  std::string title;
  bool plotted = false;
  SweepCount count = walk(sweep, false, [&](int number, const nlohmann::json& summary) {
    title = summary.value("title", "");
    plotted = plotted || has_plotted(summary, sweep.plot);
    table.add(sweep_row(number, sweep_run(sweep.axes, number), summary, sweep.plot));
  });
  table.finish();
  count.lacks_plotted = count.finished > 0 && !plotted;
  if (count.lacks_plotted) print_message("--plot = {}: no summary.json has such a number", printable(sweep.plot));
  for (const std::string& line : table.lines()) print_result("{}\n", line);
  const std::string no_plot = table.write_plot(sweep.folder / "sweep.svg", printable(title));
  if (!no_plot.empty()) print_message("no sweep.svg: {}", printable(no_plot));
  print_result("{} runs, {} finished, {} failed{}: {}/sweep.csv{}\n", count.runs, count.finished, count.failed,
               count.with_warnings > 0 ? fmt::format(", {} with warnings", count.with_warnings) : "",
               printable(sweep.folder.string()), no_plot.empty() ? ", sweep.svg" : "");
  return count;
}

}  // namespace talus

#include "tools/sweep/sweep_runs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <fstream>

#include "common/text/printable.h"
#include "tools/output/interrupt.h"
#include "tools/output/output.h"
#include "tools/pool/in_processes.h"
#include "tools/run/run_scene.h"
#include "tools/sweep/sweep_table.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

void send_to(const fs::path& file, int descriptor) {
  const int target = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (target >= 0) dup2(target, descriptor);
}

/// In a process of its own. Standard output is dropped, standard error goes into a file.
std::string run_one(const Sweep& sweep, std::vector<std::string> settings, const fs::path& part) {
  fs::remove_all(part);  // of a process with the same number, from before a restart of the machine
  send_to("/dev/null", STDOUT_FILENO);
  send_to(part_messages(part), STDERR_FILENO);
  RunOptions run;
  run.scene = sweep.scene.string();
  run.backend = sweep.backend;
  run.force = sweep.force;
  run.measure_drift = sweep.measure_drift;
  run.probe_drift = sweep.probe_drift;
  run.settings = std::move(settings);
  run.out = part;
  run.telemetry = false;
  run.hash_only = true;
  run_scene(run);
  return {};
}

/// Says once why no run begins any more.
class StopNotice {
 public:
  explicit StopNotice(fs::path folder) : folder_(std::move(folder)) {}

  bool interrupted() const { return interrupt_.requested(); }

  bool requested() {
    if (interrupted()) tell("interrupted");
    return told_;
  }

  /// After a run that failed, before what it has written is removed.
  void look_at_disk() {
    constexpr std::uintmax_t least = 1U << 20U;  // [bytes]
    std::error_code error;
    if (const fs::space_info space = fs::space(folder_, error); !error && space.available < least)
      tell(fmt::format("{}: no space left on the disk", folder_.string()));
  }

 private:
  void tell(const std::string& why) {
    if (!told_)
      print_message("{}: no run begins any more, and those at work save what they have; the same command goes on later",
                    why);
    told_ = true;
  }

  fs::path folder_;
  Interrupt interrupt_;
  bool told_ = false;
};

/// Keeps the messages of a run that failed, with the reason as the last line.
void keep_messages(const fs::path& messages, const fs::path& file, const std::string& why) {
  std::ofstream(messages, std::ios::app) << why << '\n';
  std::error_code unused;  // a full disk keeps no message, which changes nothing else
  fs::rename(messages, file, unused);
}

/// Gives the folder of a run that has ended its name. Another process may have finished the same run before, with the
/// same bits.
void give_name(const fs::path& part, const fs::path& folder) {
  if (reason_of(summary_of(folder)) != "finished") fs::remove_all(folder);
  std::error_code taken;
  fs::rename(part, folder, taken);
  if (taken && !fs::exists(folder)) throw fs::filesystem_error("cannot rename", part, folder, taken);
}

/// Puts what an ended run has left into its place; returns what is to be told of it, empty for nothing.
std::string settle(const Sweep& sweep, int number, const TaskOutcome& outcome, StopNotice& notice, SweepEnd& end) {
  const fs::path part = part_folder(sweep, number, getpid());
  const bool killed = outcome.failed && notice.interrupted();  // by a second signal, so nothing is saved
  const nlohmann::json summary = outcome.failed ? nlohmann::json::object() : summary_of(part);
  const std::string reason = killed ? "interrupted" : outcome.failed ? outcome.text : reason_of(summary);
  std::error_code unused;
  if (reason == "finished" || reason == "interrupted") {
    if (!killed) give_name(part, run_folder(sweep, number));
    fs::remove(part_messages(part), unused);
    fs::remove(failure_file(sweep, number), unused);
  } else {
    ++end.failed;
    notice.look_at_disk();
    if (!summary.empty()) give_name(part, run_folder(sweep, number));
    keep_messages(part_messages(part), failure_file(sweep, number), reason);
  }
  fs::remove_all(part, unused);
  if (outcome.failed && !killed) return ": failed " + reason;
  if (reason != "finished") return ": " + reason;
  const int warnings = warnings_of(summary);
  std::string word = warnings == 0 ? "" : fmt::format(": {} {}", warnings, warnings == 1 ? "warning" : "warnings");
  if (!has_plotted(summary, sweep.plot)) word += fmt::format(": no number {} for --plot", printable(sweep.plot));
  return word;
}

}  // namespace

std::vector<int> unfinished(const Sweep& sweep) {
  std::vector<int> numbers;
  for (int i = 0; i < sweep_size(sweep.axes); ++i)
    if (!is_finished(sweep, i)) numbers.push_back(i);
  return numbers;
}

SweepEnd do_runs(const Sweep& sweep, const std::vector<int>& numbers, int jobs) {
  require_unchanged(sweep.files, sweep.scene, "the sweep " + sweep.folder.string());
  const auto settings = [&](int task) { return settings_of(sweep.axes, sweep_run(sweep.axes, numbers[task])); };
  int done = 0;
  SweepEnd end;
  StopNotice notice(sweep.folder);
  in_processes(
      static_cast<int>(numbers.size()), jobs,
      [&, parent = getpid()](int task) {
        return run_one(sweep, settings(task), part_folder(sweep, numbers[task], parent));
      },
      [&](int task, const TaskOutcome& outcome) {
        const std::string word = settle(sweep, numbers[task], outcome, notice, end);
        print_message("{} of {}: {} {}{}", ++done, numbers.size(), run_folder(sweep, numbers[task]).filename().string(),
                      fmt::join(settings(task), " "), word);
      },
      [&] { return notice.requested(); });
  end.interrupted = notice.interrupted();
  return end;
}

}  // namespace talus

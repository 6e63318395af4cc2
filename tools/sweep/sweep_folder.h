#pragma once
// The folder of a sweep: what is run, what has ended, what is at work.

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tools/sweep/file_hashes.h"
#include "tools/sweep/sweep_plan.h"

namespace talus {

/// What a sweep runs. Its file sweep.json has all of it.
struct Sweep {
  std::filesystem::path folder;  // absolute
  std::filesystem::path scene;   // file, absolute
  FileHashes files;              // of the scenes of all runs
  std::string backend;           // empty: the dimension's first
  bool force = false;
  bool measure_drift = false;
  bool probe_drift = true;
  std::string plot = "centre_height_m";  // column of the table that sweep.svg shows
  std::vector<SweepAxis> axes;
};

/// Makes the folder. Throws std::invalid_argument where it has files of anything but a sweep.
void make_sweep_folder(const std::filesystem::path& folder);

/// Writes sweep.json, or finds there the same sweep, which then goes on: what a process that died left half-written is
/// removed. Under a lock of the whole sweep. Throws std::invalid_argument where another sweep is there.
void begin_sweep(const Sweep& sweep);

/// The sweep of a folder. Throws std::invalid_argument where it has none.
Sweep read_sweep(const std::filesystem::path& folder);

std::filesystem::path run_folder(const Sweep& sweep, int number);

/// Where a run is written until it has ended, by the process of this number on this machine: no other has this name.
std::filesystem::path part_folder(const Sweep& sweep, int number, int process);

/// Messages of a run at work, beside its folder.
std::filesystem::path part_messages(const std::filesystem::path& part);

/// Messages of a run that failed.
std::filesystem::path failure_file(const Sweep& sweep, int number);

/// The summary of a run folder; an empty object where there is none that can be read.
nlohmann::json summary_of(const std::filesystem::path& folder);

/// The reason of a summary: "finished", "interrupted", or an error; empty where there is none.
std::string reason_of(const nlohmann::json& summary);

bool is_finished(const Sweep& sweep, int number);

/// Warnings of a run about scene, window and what happened.
int warnings_of(const nlohmann::json& summary);

enum class RunState {
  finished,
  failed,
  begun,    // at work, or its process died
  waiting,  // not begun, or interrupted
};

/// States of all runs, as the folder shows them at one time.
class RunStates {
 public:
  explicit RunStates(const Sweep& sweep);
  /// `reason`: of the summary in the run's folder.
  RunState of(int number, const std::string& reason) const;
  /// The end of what a failed or begun run has printed; empty where that is nothing.
  std::string end_of_messages(int number) const;

 private:
  std::filesystem::path failures_;
  std::set<int> failed_;
  std::map<int, std::filesystem::path> begun_;  // messages
};

}  // namespace talus

#pragma once
// Options of the commands that do many runs.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/pool/task_list.h"

namespace talus {

/// The folder of the runs, where they are done, and what the command does there. One of the five folders must be given.
struct JobOptions {
  std::filesystem::path out;
  std::filesystem::path emit;
  std::filesystem::path resume;
  std::filesystem::path status;
  std::filesystem::path collect;
  std::optional<int> only;
  int jobs = 0;  // 0: not given
  std::string on = "local";
  TaskOptions tasks;

  /// How many of the folders are given.
  int folders() const;
  /// Whether other options give the runs, and not a folder.
  bool is_new() const { return !out.empty() || !emit.empty(); }
  /// Whether the runs are left to a scheduler.
  bool listed() const { return on == "slurm" || !emit.empty(); }
};

/// `most`: runs of one folder; `jobs`: what the help tells of --jobs.
void add_job_options(CLI::App& command, JobOptions& options, int most, const std::string& jobs);

/// What no option can know of by itself. `plan`: the options that tell which runs, the scene first. Throws
/// std::invalid_argument.
void check_job_options(const JobOptions& options, const std::vector<CLI::Option*>& plan);

/// Writes the list of tasks of the folder, and with --on slurm submits it; tells of it.
void leave_to_scheduler(const std::string& command, const std::filesystem::path& folder, const std::vector<Task>& tasks,
                        const JobOptions& options);

}  // namespace talus

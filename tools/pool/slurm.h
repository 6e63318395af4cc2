#pragma once
// Task lists on a cluster with Slurm, by its commands sbatch and squeue.

#include <filesystem>
#include <string>

#include "tools/pool/task_list.h"

namespace talus {

/// Submits the array, and a job that collects once all of its tasks have ended, whatever became of them. Returns what
/// to tell of it. Throws std::runtime_error where sbatch is not here or refuses.
std::string submit(const std::filesystem::path& folder, const TaskList& list);

/// Jobs of a folder that wait or are at work, by Slurm's own words; empty where there are none.
std::string jobs_left(const std::filesystem::path& folder);

/// Throws std::invalid_argument where jobs of the folder are left.
void require_no_jobs(const std::filesystem::path& folder);

}  // namespace talus

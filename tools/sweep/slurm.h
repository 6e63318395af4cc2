#pragma once
// Task lists on a cluster with Slurm, by its commands sbatch and squeue.

#include <string>

#include "tools/sweep/task_list.h"

namespace talus {

/// Submits the array, and a job that collects once all of its tasks have ended, whatever became of them. Returns what
/// to tell of it. Throws std::runtime_error where sbatch is not here or refuses.
std::string submit(const Sweep& sweep, const TaskList& list);

/// Jobs of the sweep that wait or are at work, by Slurm's own words; empty where there are none.
std::string jobs_left(const Sweep& sweep);

/// Throws std::invalid_argument where jobs of the sweep are left.
void require_no_jobs(const Sweep& sweep);

}  // namespace talus

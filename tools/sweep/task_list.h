#pragma once
// Runs of a sweep as a list of commands, for whatever starts them.

#include <string>
#include <vector>

#include "tools/sweep/sweep_folder.h"

namespace talus {

/// How a scheduler is to start the tasks.
struct TaskOptions {
  int chunk = 0;       // runs of an array's task; 0: so many that the array has at most 250 tasks
  std::string sbatch;  // options of sbatch, as they are given
};

/// The longest array that is made without a chunk: clusters allow some thousand jobs of a user at most.
inline constexpr int most_array_tasks = 250;

struct TaskList {
  int runs = 0;
  int chunk = 0;
  int tasks = 0;                  // of the array
  std::filesystem::path array;    // script
  std::filesystem::path collect;  // script
};

/// Writes tasks.txt, a shell command a line for each of these runs, array.sh, which does a chunk of them, and
/// collect.sh. All can be run from any folder and on any machine that has the same files. `numbers` must not be empty.
/// Throws std::invalid_argument where the text of an option has several lines.
TaskList write_task_list(const Sweep& sweep, const std::vector<int>& numbers, const TaskOptions& options);

}  // namespace talus

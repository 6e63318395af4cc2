#pragma once
// Runs of a command as a list of tasks, for whatever starts them.

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// How a scheduler is to start the tasks.
struct TaskOptions {
  int chunk = 0;       // lines of an array's task; 0: so many that the array has at most 250 tasks
  std::string sbatch;  // options of sbatch, as they are given
};

/// The longest array that is made without a chunk: clusters allow some thousand jobs of a user at most.
inline constexpr int most_array_tasks = 250;

/// What is to be done in a folder by `talus COMMAND --resume FOLDER --only NUMBER`.
struct Task {
  int number = 0;
  std::string about;  // for people
};

struct TaskList {
  int lines = 0;
  int chunk = 0;
  int tasks = 0;                  // of the array
  std::filesystem::path array;    // script
  std::filesystem::path collect;  // script
};

/// Writes tasks.txt, a shell command a line for each task, array.sh, which does a chunk of them, and collect.sh, which
/// does `talus COMMAND --collect FOLDER`. All can be run from any folder and on any machine that has the same files.
/// `tasks` must not be empty. Throws std::invalid_argument where the text of an option has several lines.
TaskList write_task_list(const std::string& command, const std::filesystem::path& folder,
                         const std::vector<Task>& tasks, const TaskOptions& options);

}  // namespace talus

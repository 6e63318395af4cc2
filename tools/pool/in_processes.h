#pragma once

#include <functional>
#include <string>

namespace talus {

/// What became of a task.
struct TaskOutcome {
  /// What the task returned; of a failed one what it had thrown, or how its process ended.
  std::string text;
  bool failed = false;
};

/// Tasks at a time that the commands allow.
inline constexpr int most_jobs = 1024;

/// Runs `task(i)` for i from 0 to below `count`, each in a forked process of its own and up to `jobs` at a time, and
/// gives each outcome to `done` in this process, in the order in which they end. Engines have global state, so tasks
/// cannot share a process; a crash costs one task. Once `stop`, if given, says so, no further task is begun and those
/// at work get SIGTERM; their outcomes are waited for. Throws std::system_error where no process can be made.
void in_processes(int count, int jobs, const std::function<std::string(int)>& task,
                  const std::function<void(int, const TaskOutcome&)>& done, const std::function<bool()>& stop = {});

}  // namespace talus

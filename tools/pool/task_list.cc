#include "tools/pool/task_list.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "common/text/file.h"
#include "common/text/printable.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view array_script = R"(#!/bin/sh
#SBATCH --job-name=talus --array=0-{last_task} --chdir={folder_for_sbatch} --output=slurm/%a.txt{sbatch}
# Does chunk N of tasks.txt, {chunk} lines, for index N of an array job: `sbatch array.sh`, or `sh array.sh N`.
# With --cpus-per-task=K, K lines at a time.
cd {folder} || exit
n=${{1:-${{SLURM_ARRAY_TASK_ID:?}}}}
if ! {{ [ "$n" -ge 0 ] && [ "$n" -le {last_task} ]; }} 2>/dev/null; then
  echo "array.sh: N = $n: must be a whole number from 0 to {last_task}" >&2
  exit 2
fi
first=$((n * {chunk} + 1))
sed -n "$first,$((first + {more}))p" tasks.txt |
  xargs -d '\n' -n 1 -P "${{SLURM_CPUS_PER_TASK:-1}}" sh -c 'sh -c "$1" || exit 1' line
)";

constexpr std::string_view collect_script = R"(#!/bin/sh
#SBATCH --job-name=talus_collect --chdir={folder_for_sbatch} --output=slurm/collect.txt{sbatch}
exec {talus} {command} --collect {folder}
)";

/// A word of the shell.
std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? std::string(R"('\'')") : std::string(1, letter);
  return word + "'";
}

/// A value in a line #SBATCH.
std::string sbatch_word(const std::string& text) {
  std::string word = "\"";
  for (const char letter : text) word += (letter == '"' || letter == '\\' ? "\\" : "") + std::string(1, letter);
  return word + "\"";
}

void require_one_line(std::string_view what, const std::string& text) {
  if (text.find('\n') != std::string::npos)
    throw std::invalid_argument(fmt::format("{} {}: must be one line", what, text));
}

void write_tasks(const std::string& start, const fs::path& folder, const std::vector<Task>& tasks) {
  const fs::path file = folder / "tasks.txt";
  std::ofstream list(file);
  for (const Task& task : tasks)
    list << fmt::format("{} --resume {} --only {}  # {}\n", start, shell_word(folder.string()), task.number,
                        printable(task.about));
  list.close();
  if (!list) throw std::system_error(errno, std::generic_category(), file.string());
}

}  // namespace

TaskList write_task_list(const std::string& command, const fs::path& folder, const std::vector<Task>& tasks,
                         const TaskOptions& options) {
  require_one_line("--sbatch", options.sbatch);
  require_one_line("--out", folder.string());
  const std::string talus = shell_word(fs::read_symlink("/proc/self/exe").string());
  const int lines = static_cast<int>(tasks.size());
  const int chunk = options.chunk > 0 ? options.chunk : (lines + most_array_tasks - 1) / most_array_tasks;
  TaskList list{.lines = lines,
                .chunk = chunk,
                .tasks = (lines + chunk - 1) / chunk,
                .array = folder / "array.sh",
                .collect = folder / "collect.sh"};
  const auto script = [&](const fs::path& file, std::string_view text) {
    write_file(file, fmt::format(fmt::runtime(text), fmt::arg("last_task", list.tasks - 1),
                                 fmt::arg("folder_for_sbatch", sbatch_word(folder.string())),
                                 fmt::arg("sbatch", options.sbatch.empty() ? "" : " " + options.sbatch),
                                 fmt::arg("chunk", chunk), fmt::arg("more", chunk - 1),
                                 fmt::arg("folder", shell_word(folder.string())), fmt::arg("talus", talus),
                                 fmt::arg("command", command)));
  };
  fs::create_directories(folder / "slurm");
  write_tasks(talus + " " + command, folder, tasks);
  script(list.array, array_script);
  script(list.collect, collect_script);
  return list;
}

}  // namespace talus

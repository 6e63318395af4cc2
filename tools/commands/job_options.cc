#include "tools/commands/job_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "common/text/printable.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/pool/in_processes.h"
#include "tools/pool/slurm.h"

namespace talus {

namespace fs = std::filesystem;

int JobOptions::folders() const {
  const std::array<const fs::path*, 5> all = {&out, &emit, &resume, &status, &collect};
  return static_cast<int>(std::ranges::count_if(all, [](const fs::path* folder) { return !folder->empty(); }));
}

void add_job_options(CLI::App& command, JobOptions& options, int most, const std::string& jobs) {
  command.add_option("-o,--out", options.out, "Folder of the runs: new, empty, or of the same runs to go on with")
      ->check(not_empty());
  command
      .add_option("--emit", options.emit,
                  "The same, but only write tasks.txt, a command a line, and scripts for an array of jobs")
      ->check(not_empty());
  CLI::Option* const resume =
      command.add_option("--resume", options.resume, "Go on with the runs of this folder")->check(not_empty());
  command.add_option("--status", options.status, "Count the runs of this folder, and tell of those that failed")
      ->check(not_empty());
  command.add_option("--collect", options.collect, "Write table and plot of what has ended in this folder")
      ->check(not_empty());
  command.add_option("--only", options.only, "Do the task of this number and nothing else, as a line of tasks.txt")
      ->needs(resume)
      ->check(whole_number(0, most));
  command.add_option("-j,--jobs", options.jobs, jobs)->check(whole_number(1, most_jobs));
  command.add_option("--on", options.on, "local: run here; slurm: submit an array of jobs, and return at once")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->capture_default_str();
  command.add_option("--sbatch", options.tasks.sbatch, "Options for sbatch as they stand, such as \"-p short\"");
  command
      .add_option("--chunk", options.tasks.chunk,
                  "Lines of one task of the array, one after the other; without it the array has up to 250 tasks")
      ->check(whole_number(1, most));
}

void check_job_options(const JobOptions& options, const std::vector<CLI::Option*>& plan) {
  if (options.folders() != 1)
    throw std::invalid_argument(
        "--out: must be given, or one of --emit, --resume, --status and --collect, and no two of them");
  for (const CLI::Option* option : plan)
    if (!options.is_new() && option->count() > 0)
      throw std::invalid_argument(fmt::format(
          "{}: must be left out with --resume, --status and --collect, whose folder has it", option->get_name()));
  const bool for_array = options.on != JobOptions().on || options.tasks.chunk > 0 || !options.tasks.sbatch.empty();
  const bool idle = !options.status.empty() || !options.collect.empty();
  if (idle && (options.jobs > 0 || for_array))
    throw std::invalid_argument("--jobs, --on, --chunk, --sbatch: must be left out with --status and --collect");
  if (options.only && for_array) throw std::invalid_argument("--on, --chunk, --sbatch: must be left out with --only");
  if (!options.listed() && (options.tasks.chunk > 0 || !options.tasks.sbatch.empty()))
    throw std::invalid_argument("--chunk, --sbatch: must stand with --on slurm or --emit");
  if (options.listed() && options.jobs > 0)
    throw std::invalid_argument("--jobs: must stand without --on slurm and --emit");
}

void leave_to_scheduler(const std::string& command, const fs::path& folder, const std::vector<Task>& tasks,
                        const JobOptions& options) {
  const TaskList list = write_task_list(command, folder, tasks, options.tasks);
  if (options.on == "slurm")
    print_text(submit(folder, list));
  else
    print_result("{} lines, {} tasks of {}: {}/tasks.txt, array.sh, collect.sh\n", list.lines, list.tasks, list.chunk,
                 printable(folder.string()));
}

}  // namespace talus

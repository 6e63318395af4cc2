#include "tools/pool/slurm.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "common/text/file.h"
#include "tools/pool/program.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// Numbers of the jobs, one a line.
fs::path job_file(const fs::path& folder) { return folder / "slurm" / "jobs"; }

/// The number of the new job.
std::string submitted(const fs::path& script, const std::string& option = {}) {
  std::vector<std::string> words = {"sbatch", "--parsable"};
  if (!option.empty()) words.push_back(option);
  words.push_back(script.string());
  const ProgramEnd end = run_program(words);
  if (end.exit_code == 127)
    throw std::runtime_error(
        "sbatch is not on this machine: submit where Slurm is, or write the same list for others with --emit");
  if (end.exit_code != 0) throw std::runtime_error(fmt::format("sbatch refused {}", script.string()));
  return end.out.substr(0, end.out.find_first_of(";\n"));  // NUMBER or NUMBER;CLUSTER
}

}  // namespace

std::string submit(const fs::path& folder, const TaskList& list) {
  const std::string array = submitted(list.array);
  write_file(job_file(folder), array + "\n");
  const std::string collect = submitted(list.collect, "--dependency=afterany:" + array);
  write_file(job_file(folder), array + "\n" + collect + "\n");
  return fmt::format("{} lines of tasks.txt in job {}, an array of {} tasks of {}, and job {}, which collects\n",
                     list.lines, array, list.tasks, list.chunk, collect);
}

std::string jobs_left(const fs::path& folder) {
  std::istringstream stream(file_contents(job_file(folder)).value_or(""));
  std::vector<std::string> jobs;
  for (std::string job; std::getline(stream, job);) jobs.push_back(job);
  if (jobs.empty()) return {};
  const ProgramEnd end = run_program({"squeue", "--me", "--noheader", "--array", "--format=%F %T"});
  if (end.exit_code != 0)
    return fmt::format("jobs {}, unless they have ended: squeue does not tell here (once they have, remove {})",
                       fmt::join(jobs, ","), job_file(folder).string());
  std::istringstream lines(end.out);
  std::map<std::string, int> counts;
  for (std::string job, state; lines >> job >> state;)
    if (std::ranges::find(jobs, job) != jobs.end()) ++counts[state];
  std::string text;
  for (const auto& [state, count] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, state);
  return text.empty() ? "" : fmt::format("jobs {}: {}", fmt::join(jobs, ","), text);
}

void require_no_jobs(const fs::path& folder) {
  if (const std::string jobs = jobs_left(folder); !jobs.empty())
    throw std::invalid_argument(
        fmt::format("{}: Slurm has jobs of this folder, {}; start again once they have ended, or scancel them",
                    folder.string(), jobs));
}

}  // namespace talus

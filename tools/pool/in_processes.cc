#include "tools/pool/in_processes.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <string_view>
#include <system_error>
#include <vector>

namespace talus {
namespace {

/// A process at work, and what it has written so far.
struct Worker {
  int task = 0;
  pid_t process = -1;
  int pipe = -1;
  std::string text;
};

bool write_all(int pipe, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(pipe, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

[[noreturn]] void work(const std::function<std::string(int)>& task, int number, int pipe) {
  std::string text;
  int exit_code = 0;
  try {
    text = task(number);
  } catch (const std::exception& error) {
    text = error.what();
    exit_code = 1;
  }
  if (!write_all(pipe, text)) exit_code = 2;
  _exit(exit_code);  // no buffer or handler of the parent may run twice
}

Worker start_worker(const std::function<std::string(int)>& task, int number) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t process = fork();
  if (process < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (process == 0) {
    close(ends[0]);
    work(task, number, ends[1]);
  }
  close(ends[1]);
  return {number, process, ends[0], {}};
}

/// Reads what is there; true at the end of the text.
bool read_some(Worker& worker) {
  std::array<char, 4096> buffer{};
  const ssize_t size = ::read(worker.pipe, buffer.data(), buffer.size());
  if (size > 0) worker.text.append(buffer.data(), static_cast<std::size_t>(size));
  return size == 0 || (size < 0 && errno != EINTR);
}

TaskOutcome outcome_of(const Worker& worker) {
  close(worker.pipe);
  int status = 0;
  while (waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) <= 1) return {worker.text, WEXITSTATUS(status) == 1};
  if (WIFSIGNALED(status)) return {fmt::format("ended by signal {}", WTERMSIG(status)), true};
  return {"its result was lost", true};
}

}  // namespace

void in_processes(int count, int jobs, const std::function<std::string(int)>& task,
                  const std::function<void(int, const TaskOutcome&)>& done, const std::function<bool()>& stop) {
  constexpr int look = 200;  // [ms] after which a signal that came between two calls is seen
  std::vector<Worker> workers;
  int next = 0;
  bool stopped = false;
  while (next < count || !workers.empty()) {
    if (!stopped && stop && stop()) {
      stopped = true;
      count = next;
      for (const Worker& worker : workers) kill(worker.process, SIGTERM);
    }
    while (next < count && static_cast<int>(workers.size()) < std::max(1, jobs))
      workers.push_back(start_worker(task, next++));
    std::vector<pollfd> pipes;
    for (const Worker& worker : workers) pipes.push_back({worker.pipe, POLLIN, 0});
    const int ready = poll(pipes.data(), pipes.size(), stop ? look : -1);
    if (ready < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "poll");
    if (ready <= 0) continue;
    for (std::size_t i = workers.size(); i-- > 0;) {
      if (pipes[i].revents == 0 || !read_some(workers[i])) continue;
      const Worker worker = std::move(workers[i]);
      workers.erase(workers.begin() + static_cast<std::ptrdiff_t>(i));
      done(worker.task, outcome_of(worker));
    }
  }
}

}  // namespace talus

#pragma once
// Threads that share the work of a step.

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace talus {

/// Awake bodies from which on the work of a step is shared. With fewer, threads would wait for each other longer than
/// they work.
inline constexpr int bodies_to_share = 512;

/// A fixed number of threads, the calling one among them, that work on one task at a time.
///
/// Not oneTBB: a step of the solver has some 60 places at which all threads must meet, and a loop of oneTBB costs 5 to
/// 10 us where meeting here costs less than one.
class Team {
 public:
  /// `threads`: from 1 on.
  explicit Team(int threads);
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  ~Team();

  int size() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls `task(member)` on each thread, with members from 0 (the calling thread) on; returns when all are done. The
  /// task must not throw.
  void run(const std::function<void(int)>& task);

  /// Calls `work(first, last, member)` for consecutive parts of [0, count) in parallel; returns when all are done.
  void divide(int count, const std::function<void(int, int, int)>& work);

  /// Within a task: waits for all threads. What any wrote before is then visible to all.
  void meet();

 private:
  Team() = default;  // delegated to, so that the destructor ends the threads where one more cannot be made
  void work(int member);

  const std::function<void(int)>* task_ = nullptr;
  alignas(64) std::atomic<unsigned> task_number_ = 0;
  alignas(64) std::atomic<int> arrived_ = 0;
  alignas(64) std::atomic<unsigned> meeting_ = 0;
  std::vector<std::jthread> workers_;  // joined before what they use is gone
};

/// The part of `count` things that is a member's: [first, last).
struct Share {
  int first = 0;
  int last = 0;
};
inline Share share_of(int count, int member, int members) {
  const auto bound = [&](int of) { return static_cast<int>((static_cast<long long>(count) * of) / members); };
  return {bound(member), bound(member + 1)};
}

}  // namespace talus

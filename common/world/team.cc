#include "common/world/team.h"

#include <algorithm>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace talus {
namespace {

constexpr int fewest = 64;      // things that a thread takes at a time
constexpr int most_parts = 16;  // of each thread's share at most, so that none waits long for the last
constexpr int spins = 4000;     // some 20 us, after which a waiting thread lets others run

void wait_a_moment() {
#if defined(__SSE2__)
  _mm_pause();
#endif
}

}  // namespace

Team::Team(int threads) : Team() {
  for (int member = 1; member < threads; ++member) workers_.emplace_back([this, member] { work(member); });
}

Team::~Team() {
  task_ = nullptr;
  task_number_.fetch_add(1, std::memory_order_release);
  task_number_.notify_all();
}

void Team::run(const std::function<void(int)>& task) {
  if (workers_.empty()) return task(0);
  task_ = &task;
  task_number_.fetch_add(1, std::memory_order_release);
  task_number_.notify_all();
  task(0);
  meet();
}

void Team::divide(int count, const std::function<void(int, int, int)>& work) {
  const int part = std::max(fewest, count / (most_parts * size()));
  std::atomic<int> next = 0;
  run([&](int member) {
    for (int first = next.fetch_add(part); first < count; first = next.fetch_add(part))
      work(first, std::min(first + part, count), member);
  });
}

void Team::work(int member) {
  unsigned done = 0;
  for (;;) {
    task_number_.wait(done, std::memory_order_acquire);
    ++done;
    if (task_ == nullptr) return;
    (*task_)(member);
    meet();
  }
}

void Team::meet() {
  if (workers_.empty()) return;
  const unsigned meeting = meeting_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == size()) {
    arrived_.store(0, std::memory_order_relaxed);
    meeting_.store(meeting + 1, std::memory_order_release);
    return;
  }
  for (int i = 0; meeting_.load(std::memory_order_acquire) == meeting; ++i)
    if (i < spins)
      wait_a_moment();
    else
      std::this_thread::yield();
}

}  // namespace talus

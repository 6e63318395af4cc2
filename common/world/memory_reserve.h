#pragma once

#include <sys/resource.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace talus {

/// An engine may use memory without a check that it got any, with an allocator that cannot be replaced. Where the
/// address space is limited (`ulimit -v`), this makes sure beforehand that there is enough for what comes next.
class MemoryReserve {
 public:
  MemoryReserve() {
    rlimit limit{};
    limited_ = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  }

  /// Throws std::bad_alloc unless there is memory for a step of so many bodies and contacts, the growth of the engine's
  /// arrays to twice their size included.
  void check(std::size_t bodies, std::size_t contacts) const {
    if (!limited_) return;
    constexpr std::size_t blocks = std::size_t{1} << 20;  // [bytes] of small objects
    constexpr std::size_t each = 1024;                    // [bytes] of a body or contact in the solver and the tree
    void* volatile memory = std::malloc(blocks + each * (bodies + contacts));  // volatile: or it is optimised away
    if (memory == nullptr) throw std::bad_alloc();
    std::free(memory);
  }

 private:
  bool limited_ = false;
};

}  // namespace talus

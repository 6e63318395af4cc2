#include "tools/run/huge_pages.h"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <climits>
#include <cstdint>
#include <cstdlib>

namespace talus {

#ifdef __SANITIZE_ADDRESS__

// The sanitizer's allocator has no such heap, and would mark all of the block.
void prefer_huge_pages() {}

#else

namespace {

bool is_unlimited(int resource) {
  rlimit limit{};
  return getrlimit(static_cast<__rlimit_resource>(resource), &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
}

}  // namespace

// The heap grows by addresses without memory, which are marked and given back to it. What it later uses of them gets
// huge pages.
void prefer_huge_pages() {
  constexpr std::size_t addresses = std::size_t{1} << 30;  // [bytes]
  constexpr std::size_t huge_page = std::size_t{1} << 21;  // [bytes]
  if (!is_unlimited(RLIMIT_AS) || !is_unlimited(RLIMIT_DATA)) return;
  mallopt(M_MMAP_THRESHOLD, INT_MAX);  // large arrays too lie in the heap,
  mallopt(M_TRIM_THRESHOLD, INT_MAX);  // which keeps its addresses
  void* const block = std::malloc(addresses);
  if (block == nullptr) return;
  const std::uintptr_t first = (reinterpret_cast<std::uintptr_t>(block) + huge_page - 1) & ~(huge_page - 1);
  madvise(reinterpret_cast<void*>(first), addresses - huge_page, MADV_HUGEPAGE);
  std::free(block);
}

#endif

}  // namespace talus

#include "sim3d/plain_heap.h"

#include <LinearMath/btAlignedAllocator.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace talus {
namespace {

void* take(std::size_t size, int alignment) {
  const std::size_t unit = alignment;
  void* memory =
      unit <= alignof(std::max_align_t) ? std::malloc(size) : std::aligned_alloc(unit, (size + unit - 1) / unit * unit);
  if (memory == nullptr && size > 0) throw std::bad_alloc();
  return memory;
}
void give_back(void* memory) { std::free(memory); }

}  // namespace

void use_plain_heap_in_bullet() { btAlignedAllocSetCustomAligned(take, give_back); }

}  // namespace talus

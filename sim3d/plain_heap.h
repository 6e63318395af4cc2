#pragma once

namespace talus {

/// Has all of Bullet, in the whole program, take memory from the heap as it is. Bullet by itself adds 23 bytes to each
/// piece, a tenth of what a sleeping body takes, and uses memory that it was refused; this throws std::bad_alloc. For
/// programs, at their start: what was taken before cannot be given back.
void use_plain_heap_in_bullet();

}  // namespace talus

#pragma once

namespace talus {

/// Lets the heap of this process lie in huge pages, where the system gives them on request (transparent huge pages,
/// "madvise"). A step reads memory all over the heap: with pages of 4 kB, a fifth of the time of a run of ten thousand
/// bodies goes into the translation of addresses (lab/notes/bullet_step.md). To be called once, at the start of a
/// program. Changes nothing where the system refuses, or where the address space is limited (`ulimit -v`).
void prefer_huge_pages();

}  // namespace talus

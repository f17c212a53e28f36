// What a process settles before its libraries start, and how it holds memory.
#pragma once

namespace voussoir {

/// Call first thing in main(). Re-executes the program once with what its libraries read before main() begins, each
/// where the user has not set it: OMP_WAIT_POLICY=passive, so that waiting threads sleep instead of spin, and
/// GLIBC_TUNABLES=glibc.malloc.hugetlb=1, so that all memory is asked for in large pages. From then on freed memory is
/// kept for whatever asks next (docs/developer/performance-notes.md).
void begin_process(char** argv);

/// Gives the system what is free by now: after work that needed much more than what follows.
void give_memory_back();

}  // namespace voussoir

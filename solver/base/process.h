// Settings of the process that must precede the start of its libraries, and memory management.
#pragma once

namespace voussoir {

/// Call it at the beginning of main(). It executes the program again once with two environment variables that libraries
/// read before main(), unless the user has set them: OMP_WAIT_POLICY=passive, so that waiting threads sleep instead of
/// spinning, and GLIBC_TUNABLES=glibc.malloc.hugetlb=1, so that all memory is allocated in large pages. It also sets
/// that freed memory is kept for later allocations (docs/developer/performance-notes.md).
void begin_process(char** argv);

/// Returns free memory to the system. Call it after work that needed much more memory than the following work.
void give_memory_back();

}  // namespace voussoir

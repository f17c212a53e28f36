// The limits of the machine, measured in the same run as the results that are compared with them.
#pragma once

namespace voussoir {

/// Bytes per second (read and written) of a plain copy within `bytes` of memory on `threads` threads, the best of
/// several tries. Data that fit into a cache are copied at the speed of the cache.
double copy_bandwidth(double bytes, int threads);

/// Additions and multiplications per second, in fused pairs on full registers on `threads` threads, the best of several
/// tries.
double multiply_add_peak(int threads);

/// Processor time of all threads so far, s. Time in which other programs use the cores does not count.
double processor_time();

/// Largest memory that the program has held so far, bytes.
double peak_memory();

/// Takes this many bytes of memory from the system now, and keeps them for later requests of the program. The time that
/// the system, or the host of a virtual machine, needs to provide memory is then not measured. Throws InputError if
/// there is not enough memory.
void reserve_memory(double bytes);

}  // namespace voussoir

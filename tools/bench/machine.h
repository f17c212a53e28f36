// What the machine could do at best, measured in the same run as what it is compared with.
#pragma once

namespace voussoir {

/// Bytes a second (read and written) that a plain copy within `bytes` of memory moves, best of several, on `threads`
/// threads: data that fit a cache move as fast as that cache allows.
double copy_bandwidth(double bytes, int threads);

/// Additions and multiplications a second in fused pairs on full registers, best of several, on `threads` threads.
double multiply_add_peak(int threads);

/// s of processor time so far, of all threads: does not count while other programs have the cores.
double processor_time();

/// Most bytes of memory that the program has held so far.
double peak_memory();

/// Takes so many bytes of memory from the system now, and keeps them for whatever the program asks for later: what the
/// system, or the host of a virtual machine, takes to hand out memory is then not among what is timed. Throws
/// InputError where there is not so much.
void reserve_memory(double bytes);

}  // namespace voussoir

// Flat arrays of the state and their names. A checkpoint writes them, and the state hash covers them.
#pragma once
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string>
#include <variant>
#include <vector>

namespace voussoir {

constexpr std::size_t cache_line = 64, large_page = std::size_t(2) << 20;

/// Memory aligned to cache lines. Allocations of at least a quarter of a large page consist of whole large pages,
/// because a time step of a large bridge reads tens of thousands of pages of 4 kB.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* memory, std::size_t bytes);

/// Allocates on cache-line boundaries, which the SIMD kernels rely on.
template <class T>
struct CacheAligned {
  using value_type = T;
  CacheAligned() = default;
  template <class U>
  CacheAligned(const CacheAligned<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(allocate_aligned(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) { free_aligned(p, n * sizeof(T)); }
  bool operator==(const CacheAligned&) const { return true; }
};
template <class T>
using Array = std::vector<T, CacheAligned<T>>;

/// Prefetches memory that will be needed soon. Prefetch at most a dozen cache lines at a time, and the next ones some
/// hundred cycles later: the processor drops many of a larger number (docs/developer/performance-notes.md).
[[gnu::always_inline]] inline void fetch(const void* from, std::size_t bytes) {
  for (std::size_t at = 0; at < bytes; at += cache_line) __builtin_prefetch(static_cast<const char*>(from) + at);
}

/// One array of the state under the name it has in a checkpoint file, e.g. "bodies/pose".
struct NamedArray {
  std::string name;
  std::size_t columns = 1;  // row length; the number of rows is size / columns
  std::string unit;
  std::variant<Array<double>*, Array<float>*, Array<std::int64_t>*, Array<std::int32_t>*, Array<std::uint8_t>*> data;
};

/// 64-bit hash (FNV-1a over 8-byte words, then bytes) of raw bytes, continued from `seed`.
std::uint64_t hash_bytes(const void* data, std::size_t size, std::uint64_t seed = 0xcbf29ce484222325ULL);
std::uint64_t hash_text(const std::string& text);
/// Hash of names, sizes and raw bits of all arrays in order.
std::uint64_t hash_arrays(const std::vector<NamedArray>& arrays);

}  // namespace voussoir

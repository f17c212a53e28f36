#include "solver/base/arrays.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstring>

namespace voussoir {

namespace {

constexpr std::size_t worth_a_large_page = large_page / 4;

std::align_val_t alignment_of(std::size_t bytes) {
  return std::align_val_t{bytes >= worth_a_large_page ? large_page : cache_line};
}

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  if (bytes < worth_a_large_page) return ::operator new(bytes, alignment_of(bytes));
  const std::size_t whole = (bytes + large_page - 1) / large_page * large_page;
  void* memory = ::operator new(whole, alignment_of(bytes));
#if defined(__linux__)
  madvise(memory, whole, MADV_HUGEPAGE);  // a wish: where the system grants no large pages, small ones do
#endif
  return memory;
}

void free_aligned(void* memory, std::size_t bytes) {
  ::operator delete(memory, alignment_of(bytes));
}

namespace {
constexpr std::uint64_t fnv_prime = 0x100000001b3ULL;
}

std::uint64_t hash_bytes(const void* data, std::size_t size, std::uint64_t seed) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::uint64_t h = seed;
  std::size_t i = 0;
  for (; i + 8 <= size; i += 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes + i, 8);
    h = (h ^ word) * fnv_prime;
    h ^= h >> 29;  // FNV alone never carries high bits down, and doubles differ mostly in their high bits
  }
  for (; i < size; ++i) h = (h ^ bytes[i]) * fnv_prime;
  return h;
}

std::uint64_t hash_text(const std::string& text) {
  return hash_bytes(text.data(), text.size());
}

std::uint64_t hash_arrays(const std::vector<NamedArray>& arrays) {
  std::uint64_t h = hash_text("voussoir");
  for (const NamedArray& array : arrays) {
    h = hash_bytes(array.name.data(), array.name.size(), h);
    std::visit(
        [&](const auto* values) {
          const std::uint64_t n = values->size();
          h = hash_bytes(&n, sizeof n, h);
          h = hash_bytes(values->data(), n * sizeof(*values->data()), h);
        },
        array.data);
  }
  return h;
}

}  // namespace voussoir

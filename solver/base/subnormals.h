// Subnormal numbers (below 1.2·10⁻³⁸ in single precision), with which processors are slow
// (docs/developer/performance-notes.md).
#pragma once
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace voussoir {

/// As long as the object exists, they count as zero in its thread. On processors other than x86 it does nothing.
class NoSubnormals {
 public:
  NoSubnormals() {
#if defined(__SSE2__)
    constexpr unsigned flush_results = 0x8000, flush_operands = 0x0040;
    before_ = _mm_getcsr();
    _mm_setcsr(before_ | flush_results | flush_operands);
#endif
  }
  ~NoSubnormals() {
#if defined(__SSE2__)
    _mm_setcsr(before_);
#endif
  }
  NoSubnormals(const NoSubnormals&) = delete;
  NoSubnormals& operator=(const NoSubnormals&) = delete;

 private:
  [[maybe_unused]] unsigned before_ = 0;
};

}  // namespace voussoir

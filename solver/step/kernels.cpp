#include "solver/model/kernels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>

#include "solver/base/error.h"

extern "C" const voussoir::Kernels voussoir_kernels_plain;
#ifdef VOUSSOIR_MANY_KERNELS
extern "C" const voussoir::Kernels voussoir_kernels_v3, voussoir_kernels_v4;
#endif

namespace voussoir {

namespace {

const Kernels& chosen() {
  const std::vector<const Kernels*> usable = usable_kernels();
  const char* wish = std::getenv("VOUSSOIR_KERNELS");
  if (!wish || !*wish) return *usable.back();
  std::vector<std::string> names;
  for (const Kernels* each : usable) {
    if (std::string(each->name) == wish) return *each;
    names.emplace_back(each->name);
  }
  throw InputError(
      "VOUSSOIR_KERNELS is \"{}\". This program on this processor supports {}. Leave it unset to use the last of "
      "these.",
      wish, fmt::join(names, ", "));
}

#ifdef VOUSSOIR_MANY_KERNELS
#ifdef __clang__  // before version 18 it does not know the levels; these instructions distinguish them in practice
bool has_v3() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
         __builtin_cpu_supports("fma");
}
bool has_v4() {
  return has_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#else
bool has_v3() {
  return __builtin_cpu_supports("x86-64-v3");
}
bool has_v4() {
  return __builtin_cpu_supports("x86-64-v4");
}
#endif
#endif

}  // namespace

std::vector<const Kernels*> usable_kernels() {
  std::vector<const Kernels*> all = {&voussoir_kernels_plain};
#ifdef VOUSSOIR_MANY_KERNELS
  if (has_v3()) all.push_back(&voussoir_kernels_v3);
  if (has_v4()) all.push_back(&voussoir_kernels_v4);
#endif
  return all;
}

const Kernels& kernels() {
  static const Kernels& at_work = chosen();
  return at_work;
}

}  // namespace voussoir

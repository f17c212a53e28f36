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

}  // namespace

std::vector<const Kernels*> usable_kernels() {
  std::vector<const Kernels*> all = {&voussoir_kernels_plain};
#ifdef VOUSSOIR_MANY_KERNELS
  if (__builtin_cpu_supports("x86-64-v3")) all.push_back(&voussoir_kernels_v3);
  if (__builtin_cpu_supports("x86-64-v4")) all.push_back(&voussoir_kernels_v4);
#endif
  return all;
}

const Kernels& kernels() {
  static const Kernels& at_work = chosen();
  return at_work;
}

}  // namespace voussoir

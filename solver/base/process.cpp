#include "solver/base/process.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <initializer_list>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace voussoir {

namespace {

struct Variable {
  const char *name, *value;
};

/// Whether any of them was not there.
bool set_where_missing(std::initializer_list<Variable> variables) {
  bool any = false;
  for (const Variable& v : variables)
    if (!std::getenv(v.name)) any |= setenv(v.name, v.value, 1) == 0;
  return any;
}

}  // namespace

void begin_process(char** argv) {
#if defined(__GLIBC__)
  constexpr int never = -1;
  mallopt(M_MMAP_MAX, 0), mallopt(M_TRIM_THRESHOLD, never);  // all in one heap, which gives nothing back by itself
#endif
  if (!set_where_missing({{"OMP_WAIT_POLICY", "passive"}, {"GLIBC_TUNABLES", "glibc.malloc.hugetlb=1"}})) return;
  // By its own path, so that the process keeps the name that users look for. execv() returns only on failure: then
  // both stay as they are, which is slower, not wrong.
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) execv(program.c_str(), argv);
}

void give_memory_back() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}  // namespace voussoir

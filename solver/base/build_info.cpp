#include "solver/base/build_info.h"

#include <fmt/format.h>

#include "built_with.h"  // made by CMakeLists.txt
#include "commit.h"      // made by tools/commit.cmake

namespace voussoir {

std::string program_version() {
  return VOUSSOIR_VERSION;
}

std::string build_commit() {
  return VOUSSOIR_COMMIT;
}

std::string build_compiler() {
#if defined(__clang__)
  return fmt::format("clang++ {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

std::string build_libraries() {
  return VOUSSOIR_BUILT_WITH;
}

}  // namespace voussoir

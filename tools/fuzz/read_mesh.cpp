#include "io/msh/msh_file.h"
#include "tools/fuzz/answer.h"
#include "tools/fuzz/readers.h"

namespace voussoir::fuzz {

void read_mesh(const std::string& bytes) {
  answer([&] { parse_msh(bytes, "fill.msh", 1.0); });
}

}  // namespace voussoir::fuzz

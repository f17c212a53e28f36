#include <unistd.h>

#include <filesystem>

#include "io/hdf5/assembly_file.h"
#include "solver/base/atomic_file.h"
#include "tools/fuzz/answer.h"
#include "tools/fuzz/readers.h"

namespace voussoir::fuzz {

void read_assembly(const std::string& bytes) {
  const std::filesystem::path memory = "/dev/shm";
  const auto folder = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
  const std::string path = (folder / fmt::format("voussoir-fuzz-{}.h5", ::getpid())).string();
  write_bytes(path, std::as_bytes(std::span(bytes)));
  answer([&] { voussoir::read_assembly(path); });
  std::filesystem::remove(path);
}

}  // namespace voussoir::fuzz

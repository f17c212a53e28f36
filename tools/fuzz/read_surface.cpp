#include "io/vtk/shells.h"
#include "io/vtk/surface_file.h"
#include "tools/fuzz/answer.h"
#include "tools/fuzz/readers.h"

namespace voussoir::fuzz {

void read_surface(const std::string& bytes) {
  if (bytes.empty()) return;
  const std::string file = bytes.substr(1);
  answer([&] {
    const int kind = (unsigned char)(bytes[0]) % 3;
    const Surface surface = kind == 0   ? parse_obj(file, "stone.obj")
                            : kind == 1 ? parse_stl(file, "stone.stl")
                                        : parse_ply(file, "stone.ply");
    std::vector<std::string> notes;
    split_shells(surface, "stone", notes);
  });
}

}  // namespace voussoir::fuzz

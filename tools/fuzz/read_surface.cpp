#include "io/vtk/shells.h"
#include "io/vtk/surface_file.h"
#include "tools/fuzz/answer.h"
#include "tools/fuzz/readers.h"

namespace voussoir::fuzz {

void read_surface(const std::string& bytes) {
  if (bytes.empty()) return;
  const std::string file = bytes.substr(1);
  answer([&] {
    const char first = bytes[0];
    const int kind = first >= '0' && first <= '4' ? first - '0' : (unsigned char)(first) % 5;
    const Surface surface = kind == 0   ? parse_obj(file, "stone.obj")
                            : kind == 1 ? parse_stl(file, "stone.stl")
                            : kind == 2 ? parse_ply(file, "stone.ply")
                            : kind == 3 ? parse_compas(file, "stone.json")
                                        : parse_gltf(file, "stone.gltf");
    std::vector<std::string> notes;
    split_shells(surface, "stone", notes);
  });
}

}  // namespace voussoir::fuzz

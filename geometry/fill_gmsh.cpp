#include "geometry/fill_gmsh.h"

#include <dlfcn.h>

#include <filesystem>

#include "solver/base/error.h"

namespace voussoir {

namespace {

/// Gmsh brings a graphical toolkit along that reads files of the user's as it is loaded, and takes a tenth of a second:
/// it stays out until there is something to mesh. Beside the program, or where it was built.
void* mesher() {
  static void* const library = [] {
    std::error_code error;
    const std::filesystem::path name = std::filesystem::path(VOUSSOIR_MESHER).filename();
    const std::filesystem::path beside = std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / name;
    void* found = error ? nullptr : dlopen(beside.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!found) found = dlopen(VOUSSOIR_MESHER, RTLD_NOW | RTLD_LOCAL);
    if (!found)
      throw RunError(
          "the library that meshes the fill cannot be loaded: {}; build all of the program, and keep {} beside it",
          dlerror(), name.string());
    return found;
  }();
  return library;
}

template <class Function>
Function* look_up(const char* name) {
  auto* const function = reinterpret_cast<Function*>(dlsym(mesher(), name));
  if (!function)
    throw RunError("{} has no {}: it is of another version; build all of the program", VOUSSOIR_MESHER, name);
  return function;
}

/// Before hours of meshing. The bridges have about twenty tetrahedra in a cube of the longest edge.
void check_size(const FillSpace& space, double edge) {
  constexpr double in_a_cube = 20.0, most = 2e7;
  double volume = 0.0;
  for (const Box& box : space.boxes) volume += (box.high - box.low).prod();
  const double tets = in_a_cube * volume / (edge * edge * edge);
  if (!(tets <= most))
    throw InputError(
        "[bridge] a fill of up to {:.3g} m3 in tetrahedra with edges of {:g} m is about {:.1g} of them, expected at "
        "most "
        "{:g}: choose a larger fill_edge",
        volume, edge, tets, most);
}

}  // namespace

FillMesh mesh_fill(const FillSpace& space, const FillMeshing& meshing) {
  check_size(space, meshing.edge);
  FillMesh out;
  look_up<void(const FillSpace&, const FillMeshing&, FillMesh&)>("voussoir_mesh_fill")(space, meshing, out);
  return out;
}

}  // namespace voussoir

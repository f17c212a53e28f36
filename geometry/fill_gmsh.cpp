#include "geometry/fill_gmsh.h"

#include <dlfcn.h>

#include <mutex>

#include "solver/base/error.h"
#include "solver/base/shipped.h"

namespace voussoir {

namespace {

constexpr const char* mesher_name = "libvoussoir_mesher.so";

/// Gmsh brings a graphical toolkit along that reads files of the user's as it is loaded, and takes a tenth of a second:
/// it stays out until there is something to mesh.
void* mesher() {
  static void* const library = [] {
    void* found = dlopen(shipped_library(mesher_name).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!found)
      throw RunError("the library that meshes the fill cannot be loaded: {}. Build the whole program again.",
                     dlerror());
    return found;
  }();
  return library;
}

template <class Function>
Function* look_up(const char* name) {
  auto* const function = reinterpret_cast<Function*>(dlsym(mesher(), name));
  if (!function)
    throw RunError("{} has no {}, so it has another version. Build the whole program again.", mesher_name, name);
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
        "[bridge] a fill of up to {:.3g} m3 with edges of {:g} m needs about {:.1g} tetrahedra; at most {:g} are "
        "allowed. Choose a larger fill_edge.",
        volume, edge, tets, most);
}

}  // namespace

FillMesh mesh_fill(const FillSpace& space, const FillMeshing& meshing) {
  check_size(space, meshing.edge);
  static std::mutex one_at_a_time;  // Gmsh has one model a process
  const std::lock_guard lock(one_at_a_time);
  FillMesh out;
  look_up<void(const FillSpace&, const FillMeshing&, FillMesh&)>("voussoir_mesh_fill")(space, meshing, out);
  return out;
}

}  // namespace voussoir

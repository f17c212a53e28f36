#include "io/vtk/import.h"

#include <algorithm>
#include <cmath>

#include "geometry/extent.h"
#include "geometry/flatten.h"
#include "geometry/repair.h"
#include "geometry/stiffness.h"
#include "io/hdf5/h5.h"
#include "io/vtk/import_steps.h"
#include "io/vtk/shells.h"
#include "io/vtk/surface_file.h"
#include "solver/base/error.h"

namespace voussoir {
namespace {

std::string stone(const std::string& path, const Shell& shell, std::size_t number) {
  const std::string where = shell.line ? fmt::format("{}:{}", path, shell.line) : path;
  return shell.name.empty() ? fmt::format("{}: stone {}", where, number)
                            : fmt::format("{}: object '{}' (stone {})", where, shell.name, number);
}

double size_of(const Polyhedron& shape) {
  const Box box = bounding_box(shape);
  return (box.high - box.low).norm();
}

/// What has been done to make faces plane.
struct Repairs {
  std::int64_t stones = 0;
  double moved = 0.0;  // m
  double tilt = 0.0;   // rad
  std::string where;   // of the farthest move
};

/// The remedy depends on how far the shape is from a convex one.
[[noreturn]] void refuse(const Polyhedron& shape, const std::string& where, const std::string& trouble,
                         const ImportOptions& options) {
  const double size = size_of(shape);
  for (const double share : {0.002, 0.005, 0.01, 0.02, 0.05})
    if (share > options.flatten)
      if (const auto flat = flatten(shape, share * size))
        throw InputError(
            "{} is not a convex stone: {}; to make its faces plane, corners would move by up to {:.3g} m, more than "
            "--flatten {:g} of its size ({:.3g} m) lets them: give --flatten {:g} if that is no matter, draw it plane, "
            "or "
            "cut it into convex pieces (--cells)",
            where, trouble, flat->moved, options.flatten, size, share);
  throw InputError(
      "{} is not a convex stone: {}; cut it into convex pieces, leave these in one object and give --cells objects (or "
      "name them NAME.1, NAME.2 and give --cells names): as objects of their own they would be stones of their own, "
      "with a joint between them",
      where, trouble);
}

Polyhedron cell_of(const Shell& shell, const std::string& where, const ImportOptions& options, Repairs& repairs) {
  Polyhedron shape = shell.shape;
  const Mat3 turn = options.scale * turn_of(options.up);
  for (Vec3& vertex : shape.vertices) {
    vertex = turn * vertex;
    if (!within_reach(vertex))
      throw InputError(
          "{}: a corner at ({:g}, {:g}, {:g}) m, expected coordinates up to {:g} m: look at --scale ({:g})", where,
          vertex.x(), vertex.y(), vertex.z(), farthest, options.scale);
  }
  shape = merge_coplanar_faces(shape, options.merge_angle);
  const std::string trouble = convexity_error(shape);
  if (trouble.empty()) return shape;
  const auto flat = flatten(shape, std::max(options.flatten * size_of(shape), options.search.gap));
  if (!flat) refuse(shape, where, trouble, options);
  ++repairs.stones;
  repairs.tilt = std::max(repairs.tilt, flat->tilt);
  if (flat->moved > repairs.moved) repairs.moved = flat->moved, repairs.where = where;
  return flat->shape;
}

/// Stones that meet may have been made plane in different ways: both sides of a joint may have moved.
JointSearch widened(JointSearch search, const Repairs& repairs) {
  search.gap = search.smallest_width = std::max(search.gap, 2.0 * repairs.moved);
  search.angle = std::max(search.angle, 2.0 * repairs.tilt);
  return search;
}

void note_repairs(Import& import, const Repairs& repairs, const std::string& path, const ImportOptions& options) {
  if (repairs.stones == 0) return;
  std::string note = fmt::format(
      "{}: {} stones had faces that are not plane; corners were moved by up to {:.3g} m to make them so, the "
      "farthest of {}",
      path, repairs.stones, repairs.moved, repairs.where);
  if (2.0 * repairs.moved > options.search.gap)
    note += fmt::format("; so faces that are {:.3g} m apart count as in contact", 2.0 * repairs.moved);
  import.notes.push_back(note);
}

void add_groups(Import& import) {
  for (std::size_t i = 0; i < import.objects.size(); ++i) {
    std::string name = import.objects[i];
    if (name.empty()) continue;
    std::replace(name.begin(), name.end(), '/', '_');  // a path separator in the assembly file
    import.assembly.groups["object " + name].push_back(std::int64_t(i));
  }
}

/// The remedy of overlaps is found in the other program, so its names are used.
void check_overlaps(const Import& import, const std::string& path, double gap) {
  const auto overlaps = find_overlaps(import.assembly, gap);
  if (overlaps.empty()) return;
  const auto name = [&](std::int64_t i) {
    return import.names[i].empty() ? fmt::format("stone {}", i) : fmt::format("'{}' (stone {})", import.names[i], i);
  };
  throw InputError(
      "{}: {} pairs of stones overlap; the first, {} and {}, by {:g} m; move them apart or raise the gap "
      "tolerance ({:g} m)",
      path, overlaps.size(), name(overlaps[0].a), name(overlaps[0].b), overlaps[0].depth, gap);
}

void check(const ImportOptions& options) {
  if (!(options.scale > 0.0) || !std::isfinite(options.scale))
    throw InputError("import: the scale is {}; give metres per unit of the file, such as 0.001 for mm", options.scale);
  if (!(options.material.density > 0.0))
    throw InputError("import: the density is {} kg/m3; give a value above 0", options.material.density);
}

}  // namespace

Import import_blocks(const std::string& path, const ImportOptions& options) {
  check(options);
  if (h5::File::is_hdf5(path)) return import_assembly(path, options);
  Import import;
  const Surface surface = read_surface(path);
  import.notes = surface.notes;
  const auto shells = split_shells(surface, path, import.notes);
  import.assembly.generator = "import";
  Repairs repairs;
  for (std::size_t i = 0; i < shells.size(); ++i) {
    const std::string where = stone(path, shells[i], i);
    import.assembly.blocks.emplace_back().cells = {cell_of(shells[i], where, options, repairs)};
    import.names.push_back(shells[i].name);
    import.objects.push_back(shells[i].object);
    if (shells[i].flipped) import.notes.push_back(where + " was inside-out and has been turned");
  }
  note_repairs(import, repairs, path, options);
  const JointSearch search = widened(options.search, repairs);
  check_overlaps(import, path, search.gap);
  join_cells(import, options.cells, search, path);
  give_materials(import, options, path);
  finish_blocks(import.assembly);
  fix_stones(import, options);
  import.joints = lay_joints(import.assembly, search, {options.kn, options.ks});
  add_groups(import);
  note_what_surprises(import, options, path);
  return import;
}

}  // namespace voussoir

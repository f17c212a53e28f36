#include "io/vtk/import.h"

#include <algorithm>
#include <cmath>

#include "geometry/decompose.h"
#include "geometry/extent.h"
#include "geometry/flatten.h"
#include "geometry/hull.h"
#include "geometry/repair.h"
#include "geometry/stiffness.h"
#include "io/hdf5/assembly_file.h"
#include "io/hdf5/h5.h"
#include "io/vtk/import_steps.h"
#include "io/vtk/shells.h"
#include "io/vtk/surface_file.h"
#include "solver/base/counted.h"
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

/// Repairs that made shapes convex.
struct Repairs {
  std::int64_t stones = 0;  // whose faces were made plane
  double moved = 0.0;       // m
  double tilt = 0.0;        // rad
  std::string where;        // of the farthest move
  std::int64_t hulls = 0;
  double growth = 0.0;  // the largest, share of the volume
  std::string grown;    // where
  std::int64_t cut = 0, cells = 0;
};

/// Throws InputError with a remedy that depends on how far the shape is from a convex one.
[[noreturn]] void refuse(const Polyhedron& shape, const std::string& where, const std::string& trouble,
                         const ImportOptions& options) {
  const double size = size_of(shape);
  for (const double share : {0.002, 0.005, 0.01, 0.02, 0.05})
    if (share > options.flatten)
      if (const auto flat = flatten(shape, share * size))
        throw InputError(
            "{} is not a convex stone: {}. To make its faces plane, corners would have to move by up to {:.3g} m, "
            "which is more than --flatten {:g} of its size ({:.3g} m) allows. Give --flatten {:g} if you accept that, "
            "draw plane faces, use its convex hull (--not-convex hull), or cut it into convex pieces (--cells).",
            where, trouble, flat->moved, options.flatten, size, share);
  throw InputError(
      "{} is not a convex stone: {}. Let the program cut it (--not-convex cut), or draw it as convex pieces. Put the "
      "pieces into one object and give --cells objects, or name them NAME.1, NAME.2 and give --cells names. Otherwise "
      "each piece would be a separate stone, with joints between the pieces.",
      where, trouble);
}

Polyhedron hull_of(const Polyhedron& shape, const std::string& where, const ImportOptions& options, Repairs& repairs) {
  Polyhedron hull = merge_coplanar_faces(convex_hull(shape.vertices), options.merge_angle);
  if (const std::string trouble = convexity_error(hull); !trouble.empty()) {
    const auto flat = flatten(hull, std::max(options.flatten * size_of(hull), options.search.gap));
    if (!flat) throw InputError("{}: its convex hull is not a valid stone: {}. Draw it convex.", where, trouble);
    hull = flat->shape;
  }
  const double before = mass_properties(shape).volume;
  const double growth = mass_properties(hull).volume / before - 1.0;
  if (repairs.hulls++ == 0 || growth > repairs.growth) repairs.growth = growth, repairs.grown = where;
  return hull;
}

/// Cells keep the faces of the whole; where these are not quite plane, neither are theirs.
std::vector<Polyhedron> pieces_of(const Polyhedron& shape, const std::string& where, const ImportOptions& options,
                                  Repairs& repairs) {
  std::vector<Polyhedron> cells;
  try {
    cells = decompose(shape);
  } catch (const InputError& error) {
    throw InputError("{} is not convex and cannot be cut: {}", where, error.what());
  }
  ++repairs.cut;
  repairs.cells += std::ssize(cells);
  for (Polyhedron& cell : cells) {
    cell = merge_coplanar_faces(cell, options.merge_angle);
    const std::string trouble = convexity_error(cell);
    if (trouble.empty()) continue;
    const auto flat = flatten(cell, std::max(options.flatten * size_of(shape), options.search.gap));
    if (!flat) throw InputError("{}: one of its {} pieces is not a valid cell: {}", where, cells.size(), trouble);
    cell = flat->shape;
  }
  return cells;
}

/// One cell, or, of a shape that is cut, several.
std::vector<Polyhedron> cells_of(const Shell& shell, const std::string& where, const Mat3& turn, NotConvex not_convex,
                                 const ImportOptions& options, Repairs& repairs) {
  Polyhedron shape = shell.shape;
  for (Vec3& vertex : shape.vertices) {
    vertex = turn * vertex;
    if (!within_reach(vertex))
      throw InputError(
          "{}: a corner is at ({:g}, {:g}, {:g}) m. Coordinates must be at most {:g} m. Check --units or --scale "
          "({:g}).",
          where, vertex.x(), vertex.y(), vertex.z(), farthest, options.scale);
  }
  shape = merge_coplanar_faces(shape, options.merge_angle);
  const std::string trouble = convexity_error(shape);
  if (trouble.empty()) return {shape};
  if (const auto flat = flatten(shape, std::max(options.flatten * size_of(shape), options.search.gap))) {
    ++repairs.stones;
    repairs.tilt = std::max(repairs.tilt, flat->tilt);
    if (flat->moved > repairs.moved) repairs.moved = flat->moved, repairs.where = where;
    return {flat->shape};
  }
  if (not_convex == NotConvex::refuse) refuse(shape, where, trouble, options);
  if (not_convex == NotConvex::hull) return {hull_of(shape, where, options, repairs)};
  return pieces_of(shape, where, options, repairs);
}

/// Stones that meet may have been made plane in different ways: both sides of a joint may have moved.
JointSearch widened(JointSearch search, const Repairs& repairs) {
  search.gap = search.smallest_width = std::max(search.gap, 2.0 * repairs.moved);
  search.angle = std::max(search.angle, 2.0 * repairs.tilt);
  return search;
}

void note_repairs(Import& import, const Repairs& repairs, const std::string& path, const ImportOptions& options) {
  if (repairs.hulls > 0)
    import.notes.push_back(fmt::format(
        "{}: {}; the volume grows by up to {:.3g} %, most for {}", path,
        counted(repairs.hulls, "shape was replaced by its convex hull", "shapes were replaced by their convex hulls"),
        100.0 * repairs.growth, repairs.grown));
  if (repairs.cut > 0)
    import.notes.push_back(fmt::format("{}: {} cut into {}", path, counted(repairs.cut, "shape was", "shapes were"),
                                       counted(repairs.cells, "convex cell")));
  if (repairs.stones == 0) return;
  std::string note = fmt::format(
      "{}: {} had faces that were not plane; the program has made them plane and moved corners by up to {:.3g} m, most "
      "for {}",
      path, counted(repairs.stones, "stone"), repairs.moved, repairs.where);
  if (2.0 * repairs.moved > options.search.gap)
    note += fmt::format("; faces up to {:.3g} m apart therefore count as in contact", 2.0 * repairs.moved);
  import.notes.push_back(note);
}

void add_groups(Import& import, bool of_objects) {
  for (std::size_t i = 0; i < import.objects.size(); ++i) {
    for (const std::string& group : import.meant[i].groups) import.assembly.groups[group].push_back(std::int64_t(i));
    if (!of_objects) continue;
    std::string name = import.objects[i];
    if (name.empty()) continue;
    std::replace(name.begin(), name.end(), '/', '_');  // a path separator in the assembly file
    import.assembly.groups[object_group_prefix + name].push_back(std::int64_t(i));
  }
}

/// Throws InputError for overlaps. It uses the names of the other program, in which the user corrects them.
void check_overlaps(const Import& import, const std::string& path, double gap) {
  const auto overlaps = find_overlaps(import.assembly, gap);
  if (overlaps.empty()) return;
  const auto name = [&](std::int64_t i) {
    return import.names[i].empty() ? fmt::format("stone {}", i) : fmt::format("'{}' (stone {})", import.names[i], i);
  };
  throw InputError(
      "{}: {}. The first pair, {} and {}, overlaps by {:g} m. Move them apart, or raise the gap tolerance ({:g} m).",
      path, counted(overlaps.size(), "pair of stones overlaps", "pairs of stones overlap"), name(overlaps[0].a),
      name(overlaps[0].b), overlaps[0].depth, gap);
}

void check(const ImportOptions& options) {
  if (!(options.scale > 0.0) || !std::isfinite(options.scale))
    throw InputError("import: the scale is {}. Give metres per unit of the file, such as 0.001 for mm.", options.scale);
  if (!(options.material.density > 0.0))
    throw InputError("import: the density is {} kg/m3. It must be above 0.", options.material.density);
}

/// Objects by their names; stones without one by none.
std::vector<NameRow> meanings(const std::vector<Shell>& shells, const ImportOptions& options, Import& import) {
  std::vector<NameRow> meant(shells.size());
  if (options.map.empty()) return meant;
  std::vector<bool> used(options.map.rows.size());
  for (std::size_t i = 0; i < shells.size(); ++i)
    meant[i] = meaning_of(options.map, shells[i].object, shells[i].layer, used);
  note_strangers(shells, meant, used, options.map, import.notes);
  return meant;
}

}  // namespace

Import import_blocks(const std::string& path, const ImportOptions& options) {
  check(options);
  if (h5::File::is_hdf5(path)) return import_assembly(path, options);
  return import_surface(read_surface(path), path, options);
}

Import import_surface(const Surface& surface, const std::string& path, const ImportOptions& options,
                      const std::function<NameRow(const Shell&)>& meaning) {
  check(options);
  Import import;
  import.notes = surface.notes;
  const auto shells = split_shells(surface, path, import.notes);
  import.assembly.generator = "import";
  if (meaning)
    for (const Shell& shell : shells) import.meant.push_back(meaning(shell));
  else
    import.meant = meanings(shells, options, import);
  const Mat3 turn = options.scale * turn_of(options.up.empty() ? surface.up : options.up);
  Repairs repairs;
  for (std::size_t i = 0; i < shells.size(); ++i) {
    const std::string where = stone(path, shells[i], i);
    const NotConvex how = import.meant[i].not_convex.value_or(options.not_convex);
    import.assembly.blocks.emplace_back().cells = cells_of(shells[i], where, turn, how, options, repairs);
    import.names.push_back(shells[i].name);
    import.objects.push_back(shells[i].object);
    import.supports.push_back(shells[i].support);
    if (shells[i].flipped) import.notes.push_back(where + " was inside-out and has been turned");
  }
  note_repairs(import, repairs, path, options);
  const JointSearch search = widened(options.search, repairs);
  check_overlaps(import, path, search.gap);
  join_cells(import, options.cells, search, path);
  give_places(import);
  give_materials(import, options, path);
  finish_blocks(import.assembly);
  ImportOptions meant = options;
  if (!fix_stones(import, options, path)) meant.fixed = "as stated";
  import.joints = lay_joints(import.assembly, search, {options.kn, options.ks});
  add_groups(import, options.map.object_groups);
  note_what_surprises(import, meant, path);
  return import;
}

}  // namespace voussoir

#include "io/vtk/import.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "geometry/extent.h"
#include "geometry/repair.h"
#include "geometry/stiffness.h"
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

Polyhedron cell_of(const Shell& shell, const std::string& where, const ImportOptions& options) {
  Polyhedron shape = shell.shape;
  for (Vec3& vertex : shape.vertices) {
    vertex *= options.scale;
    if (!within_reach(vertex))
      throw InputError(
          "{}: a corner at ({:g}, {:g}, {:g}) m, expected coordinates up to {:g} m: look at --scale ({:g})", where,
          vertex.x(), vertex.y(), vertex.z(), farthest, options.scale);
  }
  shape = merge_coplanar_faces(shape, options.merge_angle);
  if (const std::string trouble = convexity_error(shape); !trouble.empty())
    throw InputError("{} is not a convex stone: {}; cut it into convex pieces, one object each", where, trouble);
  return shape;
}

double lowest_point(const Block& block) {
  return block_box(block).low.z();
}

void fix_lowest(Assembly& assembly, double within) {
  double lowest = 1e300;
  for (const Block& block : assembly.blocks) lowest = std::min(lowest, lowest_point(block));
  for (Block& block : assembly.blocks) block.fixed = lowest_point(block) <= lowest + within;
}

/// One entry of a list such as "0,3,plinth": a number, or the name of an object (all its stones).
void fix_named(Import& import, const std::string& entry, const std::string& list) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), number);
  if (error == std::errc{} && end == entry.data() + entry.size() && number < import.names.size()) {
    import.assembly.blocks[number].fixed = true;
    return;
  }
  bool found = false;
  for (std::size_t i = 0; i < import.names.size(); ++i) {
    const std::string& name = import.names[i];
    if (name != entry && name.substr(0, name.rfind('#')) != entry) continue;
    import.assembly.blocks[i].fixed = found = true;
  }
  if (!found)
    throw InputError(
        "fixed stones '{}': there is no stone '{}'; give numbers 0 to {}, names of objects, 'lowest' or "
        "'none'",
        list, entry, import.names.size() - 1);
}

void fix(Import& import, const ImportOptions& options) {
  if (options.fixed == "lowest") return fix_lowest(import.assembly, std::max(1e-3, options.search.gap));
  if (options.fixed == "none") return;
  for (std::size_t at = 0; at <= options.fixed.size();) {
    const std::size_t comma = std::min(options.fixed.find(',', at), options.fixed.size());
    fix_named(import, options.fixed.substr(at, comma - at), options.fixed);
    at = comma + 1;
  }
}

void add_groups(Import& import) {
  for (std::size_t i = 0; i < import.names.size(); ++i) {
    std::string name = import.names[i].substr(0, import.names[i].rfind('#'));
    if (name.empty()) continue;
    std::replace(name.begin(), name.end(), '/', '_');  // a path separator in the assembly file
    import.assembly.groups["object " + name].push_back(std::int64_t(i));
  }
}

void set_stiffness(Assembly& assembly, const ImportOptions& options) {
  if ((options.kn > 0.0) != (options.ks > 0.0))
    throw InputError("import: kn is {} and ks {} Pa/m; give both, or neither to take them from the moduli", options.kn,
                     options.ks);
  JointRules rules;
  rules.kind = options.kn > 0.0 ? JointRules::Kind::given : JointRules::Kind::moduli;
  rules.uniform = {options.kn, options.ks};
  GeneratorInput input;
  input.materials[options.material.name] = options.material;
  input.gap_tolerance = options.search.gap;
  assign_stiffness(assembly, rules, input);
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
  const Surface surface = read_surface(path);
  const auto shells = split_shells(surface, path);
  Import import;
  import.notes = surface.notes;
  Assembly& assembly = import.assembly;
  assembly.generator = "import";
  assembly.materials = {options.material};
  for (std::size_t i = 0; i < shells.size(); ++i) {
    const std::string where = stone(path, shells[i], i);
    Block block;
    block.cells = {cell_of(shells[i], where, options)};
    assembly.blocks.push_back(block);
    import.names.push_back(shells[i].name);
    if (shells[i].flipped) import.notes.push_back(where + " was inside-out and has been turned");
  }
  finish_blocks(assembly);
  fix(import, options);
  check_overlaps(import, path, options.search.gap);
  import.joints = find_joints(assembly, options.search);
  set_stiffness(assembly, options);
  add_groups(import);
  if (std::none_of(assembly.blocks.begin(), assembly.blocks.end(), [](const Block& b) { return b.fixed; }))
    import.notes.push_back(path + ": no stone is fixed; the assembly will fall as a whole");
  return import;
}

}  // namespace voussoir

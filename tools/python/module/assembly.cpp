// Assemblies: made of arrays, read, looked at.
#include "geometry/assembly.h"

#include <filesystem>
#include <memory>

#include "io/hdf5/assembly_file.h"
#include "io/toml/table_reader.h"
#include "io/vtk/export_blocks.h"
#include "io/vtk/import.h"
#include "io/vtk/shells.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "tools/python/module/arrays.h"
#include "tools/python/module/module.h"

namespace voussoir::python {

namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// [name] and its keys as a case has them; what is left out is as `usual`.
Material material_of(const std::string& toml, const Material& usual) {
  const toml::table table = parse_toml(toml, "material");
  TableReader reader(table, "material", "the material");
  Material material = usual;
  material.name = reader.text("name", usual.name);
  read_material(reader, material);
  reader.finish();
  return material;
}

/// What is said of the blocks, one entry a block or none at all.
struct BlockWords {
  std::vector<std::string> components, materials;
  std::vector<std::int32_t> parts;
  std::vector<bool> fixed;  // empty: the lowest
};

NameRow meaning_of_block(const BlockWords& words, std::size_t block) {
  NameRow row;
  if (!words.components.empty()) {
    const auto& known = component_names();
    const auto at = std::find(known.begin(), known.end(), words.components[block]);
    if (at == known.end())
      throw InputError("block {}: '{}' is not a component{}", block, words.components[block],
                       suggestion(words.components[block], known));
    row.component = Component(at - known.begin());
  }
  if (!words.parts.empty()) row.part = words.parts[block];
  if (!words.materials.empty()) row.material = words.materials[block];
  if (!words.fixed.empty()) row.fixed = words.fixed[block];
  return row;
}

/// The cells of a block: closed surfaces of vertices (n, 3), m, and loops of vertex numbers.
void add_cell(const py::handle& vertices, const py::handle& faces, std::size_t block, Surface& surface) {
  const Numbers corners = Numbers::ensure(vertices);
  if (!corners || corners.ndim() != 2 || corners.shape(1) != 3) {
    PyErr_Clear();
    throw InputError("block {}: its vertices must be an array of shape (n, 3), in m", block);
  }
  const int first = int(surface.vertices.size());
  for (py::ssize_t i = 0; i < corners.shape(0); ++i)
    surface.vertices.emplace_back(corners.at(i, 0), corners.at(i, 1), corners.at(i, 2));
  for (const py::handle& face : faces) {
    std::vector<int> loop;
    for (const py::handle& vertex : face) {
      const auto index = vertex.cast<py::ssize_t>();
      if (index < 0 || index >= corners.shape(0))
        throw InputError("block {}: a face has the vertex {}. It must be from 0 to {}", block, index,
                         corners.shape(0) - 1);
      loop.push_back(first + int(index));
    }
    surface.objects.back().faces.push_back(int(surface.faces.size()));
    surface.faces.push_back(std::move(loop));
    surface.face_lines.push_back(0);
  }
}

Surface surface_of(const py::sequence& blocks) {
  Surface surface;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    surface.objects.emplace_back().name = fmt::format("{}", i);
    for (const py::handle& cell : blocks[i]) {
      const auto pair = cell.cast<py::tuple>();
      if (pair.size() != 2)
        throw InputError("block {}: a cell has {} entries. Give a tuple (vertices, faces)", i, pair.size());
      add_cell(pair[0], pair[1], i, surface);
    }
    if (surface.objects.back().faces.empty()) throw InputError("block {} has no faces", i);
  }
  if (surface.objects.empty()) throw InputError("there are no blocks");
  return surface;
}

void check_lengths(const BlockWords& words, std::size_t blocks) {
  const auto check = [&](std::size_t given, const char* what) {
    if (given != 0 && given != blocks)
      throw InputError("'{}' has {} for {}. Give one entry for each block, or none", what,
                       counted(given, "entry", "entries"), counted(blocks, "block"));
  };
  check(words.components.size(), "components"), check(words.parts.size(), "parts");
  check(words.materials.size(), "block_materials"), check(words.fixed.size(), "fixed");
}

struct Made {
  std::shared_ptr<Assembly> assembly;
  std::vector<std::string> notes;
};

Made made(Import import) {
  return {std::make_shared<Assembly>(std::move(import.assembly)), std::move(import.notes)};
}

Made from_arrays(const py::sequence& blocks, const BlockWords& words, const std::vector<std::string>& materials,
                 double kn, double ks, double gap, const std::map<std::string, std::vector<std::int64_t>>& groups) {
  const Surface surface = surface_of(blocks);
  check_lengths(words, surface.objects.size());
  ImportOptions options;
  if (std::any_of(blocks.begin(), blocks.end(), [](const py::handle& block) { return py::len(block) > 1; }))
    options.cells = CellRule::objects;
  options.kn = kn, options.ks = ks;
  options.search = careful_search(gap);
  options.map.path = "materials";
  options.map.object_groups = false;
  options.keep_fixed = !words.fixed.empty();
  if (options.keep_fixed) options.fixed = "none";
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (i == 0) options.material = material_of(materials[i], options.material);
    if (i > 0) options.map.materials.push_back(material_of(materials[i], options.material));
  }
  Import import = import_surface(surface, "blocks", options, [&](const Shell& shell) {
    return meaning_of_block(words, std::size_t(std::stoul(shell.object)));
  });
  import.assembly.generator = "python";
  for (const auto& [name, members] : groups) {
    for (const std::int64_t block : members)
      if (block < 0 || block >= std::ssize(import.assembly.blocks))
        throw InputError("the group '{}' contains the block {}. Blocks must be from 0 to {}.", name, block,
                         import.assembly.blocks.size() - 1);
    import.assembly.groups[name] = members;
  }
  return made(std::move(import));
}

Made from_file(const std::string& path, double scale, const std::string& up, const std::string& fixed,
               const std::string& map, double kn, double ks, double gap, const std::string& material) {
  ImportOptions options;
  options.scale = scale, options.up = up, options.fixed = fixed.empty() ? "lowest" : fixed;
  options.keep_fixed = fixed.empty();
  options.kn = kn, options.ks = ks;
  options.search = careful_search(gap);
  if (!material.empty()) options.material = material_of(material, options.material);
  if (!map.empty()) options.map = read_name_map(map, options.material);
  return made(import_blocks(path, options));
}

py::dict joints_of(const Assembly& a) {
  py::dict d;
  const auto& j = a.joints;
  d["a"] = column<std::int64_t>(j, [](const Joint& joint) { return joint.a; });
  d["b"] = column<std::int64_t>(j, [](const Joint& joint) { return joint.b; });
  d["area"] = column<double>(j, [](const Joint& joint) { return joint.area; });
  d["centroid"] = vectors(j, [](const Joint& joint) { return polygon_centroid(joint.polygon); });
  d["normal"] = vectors(j, [](const Joint& joint) { return joint.normal; });
  d["kn"] = column<double>(j, [](const Joint& joint) { return joint.kn; });
  d["ks"] = column<double>(j, [](const Joint& joint) { return joint.ks; });
  d["law"] = column<std::int32_t>(j, [](const Joint& joint) { return joint.law; });
  return d;
}

const Block& block_at(const Assembly& a, std::int64_t i) {
  if (i < 0 || i >= std::ssize(a.blocks))
    throw py::index_error(
        fmt::format("there is no block {}. The assembly has the blocks 0 to {}.", i, std::ssize(a.blocks) - 1));
  return a.blocks[std::size_t(i)];
}

/// [(vertices, faces), …] of the convex cells.
py::list cells_of_block(const Assembly& a, std::int64_t i) {
  py::list cells;
  for (const Polyhedron& cell : block_at(a, i).cells) cells.append(py::make_tuple(vectors(cell.vertices), cell.faces));
  return cells;
}

void export_assembly(const Assembly& a, const std::filesystem::path& to) {
  const std::string path = to.string();
  const auto ends = [&](const char* ending) { return path.ends_with(ending); };
  if (!ends(".obj") && !ends(".json")) throw InputError("{}: give the ending .obj or .json (COMPAS)", path);
  write_atomically(path, (ends(".obj") ? export_obj(a) : export_compas(a)).text);
}

std::vector<std::string> block_materials(const Assembly& a) {
  std::vector<std::string> names;
  for (const Block& b : a.blocks) names.push_back(a.materials[std::size_t(b.material)].name);
  return names;
}

py::array_t<double> polygon_of_joint(const Assembly& a, std::size_t i) {
  if (i >= a.joints.size())
    throw py::index_error(fmt::format("there is no joint {}. The assembly has {}, counted from 0.", i,
                                      counted(a.joints.size(), "joint")));
  return vectors(a.joints[i].polygon);
}

py::array_t<std::int32_t> tets_of(const Assembly& a) {
  return table<std::int32_t>(a.fill.tets.size(), 4, [&](std::size_t i, std::size_t c) { return a.fill.tets[i][c]; });
}

std::vector<std::string> block_components(const Assembly& a) {
  std::vector<std::string> names;
  for (const Block& b : a.blocks) names.push_back(component_names()[std::size_t(b.component)]);
  return names;
}

}  // namespace

void bind_assembly(py::module_& m) {
  using Path = std::filesystem::path;
  py::class_<Assembly, std::shared_ptr<Assembly>>(
      m, "Assembly",
      "Stones, the joints between them and a deformable fill, all in SI units. "
      "Made by Case.assembly(), assembly_from_blocks(), import_blocks() or read().")
      .def_static(
          "read", [](const Path& path) { return std::make_shared<Assembly>(read_assembly(path.string())); },
          py::arg("path"), "Reads an assembly file (HDF5). Raises InputError that names file, dataset and row.")
      .def(
          "write", [](const Assembly& a, const Path& path) { write_assembly(path.string(), a); }, py::arg("path"),
          "Writes an assembly file (HDF5), which cases can name and every verb reads.")
      .def("export", &export_assembly, py::arg("path"),
           "Writes the shapes for other programs: .obj, or .json for COMPAS. Joints are not written.")
      .def("__len__", [](const Assembly& a) { return a.blocks.size(); })
      .def_property_readonly("hash", &assembly_hash,
                             "Digest of 64 bits. It is equal for assemblies that move identically, bit for bit.")
      .def_property_readonly(
          "centroids", [](const Assembly& a) { return vectors(a.blocks, [](auto& b) { return b.centroid; }); },
          "Centroids of the blocks, shape (n, 3), m.")
      .def_property_readonly(
          "masses", [](const Assembly& a) { return column<double>(a.blocks, [](auto& b) { return b.mass; }); },
          "Masses of the blocks, shape (n,), kg.")
      .def_property_readonly(
          "fixed", [](const Assembly& a) { return column<bool>(a.blocks, [](auto& b) { return b.fixed; }); },
          "Whether each block moves with the ground, shape (n,).")
      .def_property_readonly(
          "parts", [](const Assembly& a) { return column<std::int32_t>(a.blocks, [](auto& b) { return b.part; }); },
          "Number of each block's part among those of its component, shape (n,).")
      .def_property_readonly("components", &block_components, "Component of each block: 'arch', 'pier', ...")
      .def_property_readonly("materials", &block_materials, "Name of each block's material.")
      .def_property_readonly(
          "groups", [](const Assembly& a) { return a.groups; }, "Named groups: {name: [block, ...]}.")
      .def_property_readonly(
          "joints", &joints_of,
          "Joints as a dictionary of arrays: a, b (blocks), area (m2), centroid (m, 3), normal (from a "
          "to b, 3), kn, ks (Pa/m), law (number of the joint law).")
      .def("block", &cells_of_block, py::arg("index"),
           "Convex cells of a block: [(vertices of shape (v, 3) in m, [[vertex, ...], ...]), ...].")
      .def("joint_polygon", &polygon_of_joint, py::arg("index"), "Corners of a joint, shape (c, 3), m.")
      .def_property_readonly(
          "fill_nodes", [](const Assembly& a) { return vectors(a.fill.nodes); },
          "Nodes of the deformable fill, shape (k, 3), m.")
      .def_property_readonly("fill_tets", &tets_of, "Tetrahedra of the deformable fill, shape (t, 4): nodes.");
  m.def("component_names", &component_names, "Names that components can have.");
  m.def("_from_arrays", [](const py::sequence& blocks, std::vector<std::string> components,
                           std::vector<std::int32_t> parts, std::vector<std::string> block_materials,
                           std::vector<bool> fixed, const std::vector<std::string>& materials, double kn, double ks,
                           double gap, const std::map<std::string, std::vector<std::int64_t>>& groups) {
    Made result =
        from_arrays(blocks, {std::move(components), std::move(block_materials), std::move(parts), std::move(fixed)},
                    materials, kn, ks, gap, groups);
    return std::make_pair(result.assembly, result.notes);
  });
  m.def("_from_file", [](const std::string& path, double scale, const std::string& up, const std::string& fixed,
                         const std::string& map, double kn, double ks, double gap, const std::string& material) {
    Made result = from_file(path, scale, up, fixed, map, kn, ks, gap, material);
    return std::make_pair(result.assembly, result.notes);
  });
}

}  // namespace voussoir::python

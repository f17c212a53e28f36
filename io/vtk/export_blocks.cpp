#include "io/vtk/export_blocks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "solver/base/counted.h"
#include "solver/base/json_file.h"

namespace voussoir {
namespace {

std::string place_of(const Block& block) {
  return fmt::format("{}_{}", component_names()[std::size_t(block.component)], block.part);
}

std::string name_of_block(const Assembly& assembly, std::size_t block) {
  return fmt::format("{}_b{}", place_of(assembly.blocks[block]), block);
}

std::string name_of_cell(const Assembly& assembly, std::size_t block, std::size_t cell) {
  return fmt::format("{}_c{}", name_of_block(assembly, block), cell);
}

/// Materials with unique names; effects may give several materials the same name.
std::vector<Material> with_own_names(const Assembly& assembly, std::vector<std::string>& notes) {
  std::vector<Material> materials = assembly.materials;
  std::set<std::string> known;
  for (Material& m : materials) {
    const std::string name = m.name.empty() ? "material" : m.name;
    m.name = name;
    for (int k = 2; !known.insert(m.name).second; ++k) m.name = fmt::format("{} ({})", name, k);
    if (!(m.youngs_modulus > 0.0) || !(m.shear_modulus > 0.0))
      notes.push_back(fmt::format("the material {} has no moduli; an import uses those of its options", m.name));
  }
  return materials;
}

template <class Value, class Of>
Value most_common(const std::vector<std::size_t>& blocks, Of of) {
  std::map<Value, std::size_t> counts;
  for (const std::size_t i : blocks) ++counts[of(i)];
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// A row for each component and part, and one for every block that differs from the most of these or is in groups.
NameMap map_of(const Assembly& assembly, std::vector<std::string>& notes) {
  NameMap map;
  map.object_groups = false;
  map.materials = with_own_names(assembly, notes);
  const auto material = [&](std::size_t i) { return assembly.blocks[i].material; };
  const auto fixed = [&](std::size_t i) { return assembly.blocks[i].fixed; };
  std::map<std::string, std::vector<std::size_t>> places;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) places[place_of(assembly.blocks[i])].push_back(i);
  std::map<std::size_t, NameRow> own;
  for (const auto& [place, blocks] : places) {
    NameRow row;
    row.pattern = place + "_b*";
    row.component = assembly.blocks[blocks[0]].component;
    row.part = assembly.blocks[blocks[0]].part;
    const std::int32_t usual = most_common<std::int32_t>(blocks, material);
    const bool still = most_common<bool>(blocks, fixed);
    row.material = map.materials[std::size_t(usual)].name;
    row.fixed = still;
    map.rows.push_back(row);
    for (const std::size_t i : blocks) {
      if (material(i) != usual) own[i].material = map.materials[std::size_t(material(i))].name;
      if (fixed(i) != still) own[i].fixed = fixed(i);
    }
  }
  NameRow cells;
  cells.pattern = "*_b*_c*";
  cells.block = "*_b*";
  map.rows.push_back(cells);
  for (const auto& [name, members] : assembly.groups)
    for (const std::int64_t i : members) own[std::size_t(i)].groups.push_back(name);
  for (auto& [i, row] : own) {
    row.pattern = name_of_block(assembly, i) + "_c*";
    map.rows.push_back(row);
  }
  return map;
}

std::vector<std::string> left_out(const Assembly& assembly) {
  std::vector<std::string> notes = {
      "joints are not written: an import finds them where faces meet, with stiffness and strength from the materials "
      "(joints of generated bridges may have other values, from tables)"};
  const auto is_bar = [&](const Joint& j) { return assembly.laws[std::size_t(j.law)].kind == JointLaw::Kind::tie; };
  if (const auto ties = std::count_if(assembly.joints.begin(), assembly.joints.end(), is_bar); ties > 0)
    notes.push_back(fmt::format("{} not written", counted(ties, "tie is", "ties are")));
  if (!assembly.fill.empty())
    notes.push_back(fmt::format("the deformable fill is not written: {} on {}",
                                counted(assembly.fill.tets.size(), "tetrahedron", "tetrahedra"),
                                counted(assembly.fill.nodes.size(), "node")));
  if (!assembly.sensors.empty())
    notes.push_back(fmt::format("{} not written", counted(assembly.sensors.size(), "sensor is", "sensors are")));
  if (!assembly.effects.empty())
    notes.push_back(fmt::format("of the effects ({}) only the changes of shapes and materials are written",
                                fmt::join(assembly.effects, "; ")));
  std::vector<std::string> empty;
  for (const auto& [name, members] : assembly.groups)
    if (members.empty()) empty.push_back(name);
  if (!empty.empty()) notes.push_back(fmt::format("groups without blocks are not written: {}", fmt::join(empty, ", ")));
  return notes;
}

ExportedBlocks begun(const Assembly& assembly) {
  ExportedBlocks out;
  out.notes = left_out(assembly);
  out.map = map_of(assembly, out.notes);
  return out;
}

nlohmann::json compas_block(const Polyhedron& shape, const std::string& name) {
  nlohmann::json vertex = nlohmann::json::object(), face = nlohmann::json::object(), none = nlohmann::json::object();
  for (std::size_t v = 0; v < shape.vertices.size(); ++v) {
    const Vec3& p = shape.vertices[v];
    vertex[fmt::format("{}", v)] = {{"x", p.x()}, {"y", p.y()}, {"z", p.z()}};
  }
  for (std::size_t f = 0; f < shape.faces.size(); ++f) face[fmt::format("{}", f)] = shape.faces[f];
  return {{"dtype", "compas_assembly.datastructures/Block"},
          {"name", name},
          {"data",
           {{"attributes", {{"name", name}}},
            {"default_vertex_attributes", {{"x", 0.0}, {"y", 0.0}, {"z", 0.0}}},
            {"default_edge_attributes", none},
            {"default_face_attributes", none},
            {"vertex", vertex},
            {"face", face},
            {"facedata", none},
            {"edgedata", none},
            {"max_vertex", std::int64_t(shape.vertices.size()) - 1},
            {"max_face", std::int64_t(shape.faces.size()) - 1}}}};
}

}  // namespace

ExportedBlocks export_obj(const Assembly& assembly) {
  ExportedBlocks out = begun(assembly);
  out.text = "# Blocks of voussoir: metres, z up; one convex cell an object.\n";
  std::size_t first = 1;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    out.text += fmt::format("g {}\n", place_of(assembly.blocks[i]));
    for (std::size_t c = 0; c < assembly.blocks[i].cells.size(); ++c) {
      const Polyhedron& cell = assembly.blocks[i].cells[c];
      out.text += fmt::format("o {}\n", name_of_cell(assembly, i, c));
      for (const Vec3& p : cell.vertices) out.text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
      for (const auto& loop : cell.faces) {
        out.text += 'f';
        for (const int v : loop) out.text += fmt::format(" {}", first + std::size_t(v));
        out.text += '\n';
      }
      first += cell.vertices.size();
    }
  }
  return out;
}

ExportedBlocks export_compas(const Assembly& assembly) {
  ExportedBlocks out = begun(assembly);
  const nlohmann::json none = nlohmann::json::object();
  nlohmann::json nodes = none;
  std::size_t several = 0, number = 0;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    several += block.cells.size() > 1;
    for (std::size_t c = 0; c < block.cells.size(); ++c)
      nodes[fmt::format("{}", number++)] = {{"block", compas_block(block.cells[c], name_of_cell(assembly, i, c))},
                                            {"is_support", block.fixed},
                                            {"density", block_density(assembly, block)}};
  }
  if (several > 0)
    out.notes.push_back(fmt::format("{} written as one node for each cell: in COMPAS each cell is a separate block",
                                    counted(several, "block of several cells is", "blocks of several cells are")));
  const nlohmann::json graph = {{"dtype", "compas.datastructures/Graph"},
                                {"data",
                                 {{"attributes", none},
                                  {"default_node_attributes", {{"block", nullptr}, {"is_support", false}}},
                                  {"default_edge_attributes", none},
                                  {"node", nodes},
                                  {"edge", none},
                                  {"max_node", std::int64_t(number) - 1}}}};
  out.text = json_text({{"dtype", "compas_assembly.datastructures/Assembly"},
                        {"data", {{"attributes", {{"name", "voussoir"}}}, {"graph", graph}}}},
                       -1);
  return out;
}

}  // namespace voussoir

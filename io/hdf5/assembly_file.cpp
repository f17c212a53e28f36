#include "io/hdf5/assembly_file.h"

#include <algorithm>
#include <variant>

#include "geometry/joints.h"
#include "io/hdf5/h5.h"
#include "io/hdf5/shape_arrays.h"
#include "solver/base/arrays.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// One dataset in the making.
struct Table {
  std::string name, unit;
  std::size_t columns = 1;
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::int32_t>, std::vector<std::uint8_t>>
      values;
};
using Tables = std::vector<Table>;

/// The outer boundary of a block; loops of a block of several cells share equal vertices.
Polyhedron boundary(const Block& block) {
  if (block.cells.size() == 1) return block.cells[0];
  Polyhedron shape;
  for (const Polygon& loop : outer_faces(block)) {
    auto& face = shape.faces.emplace_back();
    for (const Vec3& p : loop) {
      std::size_t v = 0;
      while (v < shape.vertices.size() && (shape.vertices[v] - p).squaredNorm() > 1e-18) ++v;
      if (v == shape.vertices.size()) shape.vertices.push_back(p);
      face.push_back(int(v));
    }
  }
  return shape;
}

void add_shapes(Tables& tables, const std::string& group, const std::string& faces, ShapeArrays&& arrays) {
  tables.push_back({group + "/vertices", "m", 3, std::move(arrays.vertices)});
  tables.push_back({group + "/vertex_offset", "", 1, std::move(arrays.vertex_offset)});
  tables.push_back({group + "/face_vertices", "", 1, std::move(arrays.face_vertices)});
  tables.push_back({group + "/face_offset", "", 1, std::move(arrays.face_offset)});
  tables.push_back({group + "/" + faces, "", 1, std::move(arrays.shape_face_offset)});
}

void add_cells(Tables& tables, const Assembly& assembly) {
  ShapeArrays cells;
  std::vector<std::int64_t> owner;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    if (assembly.blocks[i].cells.size() < 2) continue;
    for (const Polyhedron& cell : assembly.blocks[i].cells) {
      cells.add(cell);
      owner.push_back(std::int64_t(i));
    }
  }
  tables.push_back({"cells/block", "", 1, std::move(owner)});
  add_shapes(tables, "cells", "cell_face_offset", std::move(cells));
}

void add_blocks(Tables& tables, const Assembly& assembly) {
  ShapeArrays shapes;
  std::vector<std::int32_t> component, part, material;
  std::vector<double> density, mass, centroid, inertia;
  std::vector<std::uint8_t> fixed;
  for (const Block& block : assembly.blocks) {
    shapes.add(boundary(block));
    component.push_back(std::int32_t(block.component));
    part.push_back(block.part);
    material.push_back(block.material);
    fixed.push_back(block.fixed);
    density.push_back(block_density(assembly, block));
    mass.push_back(block.mass);
    centroid.insert(centroid.end(), block.centroid.data(), block.centroid.data() + 3);
    const Mat3& j = block.inertia;
    inertia.insert(inertia.end(), {j(0, 0), j(1, 1), j(2, 2), j(0, 1), j(0, 2), j(1, 2)});
  }
  add_shapes(tables, "blocks", "block_face_offset", std::move(shapes));
  tables.push_back({"blocks/component", "", 1, std::move(component)});
  tables.push_back({"blocks/part", "", 1, std::move(part)});
  tables.push_back({"blocks/material", "", 1, std::move(material)});
  tables.push_back({"blocks/density", "kg/m3", 1, std::move(density)});
  tables.push_back({"blocks/mass", "kg", 1, std::move(mass)});
  tables.push_back({"blocks/centroid", "m", 3, std::move(centroid)});
  tables.push_back({"blocks/inertia", "kg m2", 6, std::move(inertia)});
  tables.push_back({"blocks/fixed", "", 1, std::move(fixed)});
}

/// Columns that joints between blocks and patches of the fill have in common.
struct JointColumns {
  std::vector<std::int64_t> blocks, polygon_offset = {0};
  std::vector<std::int32_t> cells, faces, law;
  std::vector<double> polygon, normal, area, kn, ks;

  template <class AnyJoint>
  void add(const AnyJoint& joint) {
    for (const Vec3& p : joint.polygon) polygon.insert(polygon.end(), p.data(), p.data() + 3);
    polygon_offset.push_back(std::int64_t(polygon.size() / 3));
    normal.insert(normal.end(), joint.normal.data(), joint.normal.data() + 3);
    area.push_back(joint.area);
    kn.push_back(joint.kn);
    ks.push_back(joint.ks);
    law.push_back(joint.law);
  }
};

/// Joints between blocks, then the patches of the fill; its triangle t is the block −1 − t there.
void add_joints(Tables& tables, const Assembly& assembly) {
  JointColumns c;
  for (const Joint& joint : assembly.joints) {
    c.blocks.insert(c.blocks.end(), {joint.a, joint.b});
    c.cells.insert(c.cells.end(), {joint.cell_a, joint.cell_b});
    c.faces.insert(c.faces.end(), {joint.face_a, joint.face_b});
    c.add(joint);
  }
  for (const FillJoint& joint : assembly.fill_joints) {
    c.blocks.insert(c.blocks.end(), {joint.block, -1 - std::int64_t(joint.triangle)});
    c.cells.insert(c.cells.end(), {joint.cell, -1});
    c.faces.insert(c.faces.end(), {joint.face, -1});
    c.add(joint);
  }
  tables.push_back({"joints/blocks", "", 2, std::move(c.blocks)});
  tables.push_back({"joints/cells", "", 2, std::move(c.cells)});
  tables.push_back({"joints/faces", "", 2, std::move(c.faces)});
  tables.push_back({"joints/polygon", "m", 3, std::move(c.polygon)});
  tables.push_back({"joints/polygon_offset", "", 1, std::move(c.polygon_offset)});
  tables.push_back({"joints/normal", "", 3, std::move(c.normal)});
  tables.push_back({"joints/area", "m2", 1, std::move(c.area)});
  tables.push_back({"joints/kn", "Pa/m", 1, std::move(c.kn)});
  tables.push_back({"joints/ks", "Pa/m", 1, std::move(c.ks)});
  tables.push_back({"joints/law", "", 1, std::move(c.law)});
}

template <std::size_t N>
std::vector<std::int64_t> flat(const std::vector<std::array<std::int32_t, N>>& rows) {
  std::vector<std::int64_t> values;
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return values;
}

/// Nothing for an assembly without a fill, whose hash is then what it was before there were any.
void add_fill(Tables& tables, const FillMesh& fill) {
  if (fill.empty()) return;
  std::vector<double> nodes;
  for (const Vec3& p : fill.nodes) nodes.insert(nodes.end(), p.data(), p.data() + 3);
  tables.push_back({"fill/nodes", "m", 3, std::move(nodes)});
  tables.push_back({"fill/tets", "", 4, flat(fill.tets)});
  tables.push_back({"fill/triangles", "", 3, flat(fill.triangles)});
  tables.push_back({"fill/material", "", 1, fill.material});
}

/// One member of every element of a list.
template <class Row>
std::vector<double> gather(const std::vector<Row>& rows, double Row::*member) {
  std::vector<double> values;
  for (const Row& row : rows) values.push_back(row.*member);
  return values;
}

void add_laws(Tables& tables, const Assembly& assembly) {
  const auto& laws = assembly.laws;
  std::vector<double> energy;
  std::vector<std::int32_t> kind;
  for (const JointLaw& law : laws) {
    energy.insert(energy.end(), law.fracture_energy.begin(), law.fracture_energy.end());
    kind.push_back(std::int32_t(law.kind));
  }
  tables.push_back({"laws/tension", "Pa", 1, gather(laws, &JointLaw::tension)});
  tables.push_back({"laws/cohesion", "Pa", 1, gather(laws, &JointLaw::cohesion)});
  tables.push_back({"laws/friction_angle", "rad", 1, gather(laws, &JointLaw::friction_angle)});
  tables.push_back({"laws/residual_cohesion", "Pa", 1, gather(laws, &JointLaw::residual_cohesion)});
  tables.push_back({"laws/residual_friction_angle", "rad", 1, gather(laws, &JointLaw::residual_friction_angle)});
  tables.push_back({"laws/dilation_angle", "rad", 1, gather(laws, &JointLaw::dilation_angle)});
  tables.push_back({"laws/fracture_energy", "J/m2", 2, std::move(energy)});
  tables.push_back({"laws/kind", "", 1, std::move(kind)});
  if (std::any_of(laws.begin(), laws.end(), [](const JointLaw& law) { return law.prestress != 0.0; }))
    tables.push_back({"laws/prestress", "Pa", 1, gather(laws, &JointLaw::prestress)});
  if (std::none_of(laws.begin(), laws.end(), [](const JointLaw& l) { return l.kind == JointLaw::Kind::composite; }))
    return;
  tables.push_back({"laws/compressive_strength", "Pa", 1, gather(laws, &JointLaw::compressive_strength)});
  tables.push_back({"laws/compressive_energy", "J/m2", 1, gather(laws, &JointLaw::compressive_energy)});
  tables.push_back({"laws/compressive_peak", "m", 1, gather(laws, &JointLaw::compressive_peak)});
  tables.push_back({"laws/cap_shear", "-", 1, gather(laws, &JointLaw::cap_shear)});
  tables.push_back({"laws/dilation_length", "m", 1, gather(laws, &JointLaw::dilation_length)});
  tables.push_back({"laws/dilation_pressure", "Pa", 1, gather(laws, &JointLaw::dilation_pressure)});
}

void add_materials(Tables& tables, const Assembly& assembly) {
  const auto& materials = assembly.materials;
  tables.push_back({"materials/density", "kg/m3", 1, gather(materials, &Material::density)});
  tables.push_back({"materials/youngs_modulus", "Pa", 1, gather(materials, &Material::youngs_modulus)});
  tables.push_back({"materials/shear_modulus", "Pa", 1, gather(materials, &Material::shear_modulus)});
  tables.push_back({"materials/tensile_strength", "Pa", 1, gather(materials, &Material::tensile_strength)});
  tables.push_back({"materials/cohesion", "Pa", 1, gather(materials, &Material::cohesion)});
  tables.push_back({"materials/friction_angle", "rad", 1, gather(materials, &Material::friction_angle)});
  const auto dilates = [](const Material& m) { return m.dilation_angle != 0.0; };
  if (!assembly.fill.empty() || std::any_of(materials.begin(), materials.end(), dilates))
    tables.push_back({"materials/dilation_angle", "rad", 1, gather(materials, &Material::dilation_angle)});
}

Tables mechanics(const Assembly& assembly) {
  Tables tables;
  add_blocks(tables, assembly);
  add_cells(tables, assembly);
  add_joints(tables, assembly);
  add_fill(tables, assembly.fill);
  add_laws(tables, assembly);
  add_materials(tables, assembly);
  return tables;
}

void write_names(h5::File& file, const Assembly& assembly) {
  file.set_texts("blocks/component", "names", component_names());
  file.set_texts("laws/kind", "names", joint_law_kinds());
  std::vector<std::string> names;
  for (const Material& material : assembly.materials) names.push_back(material.name);
  file.set_texts("materials", "names", names);
}

bool has_objects(const Assembly& assembly) {
  const auto next = assembly.groups.lower_bound(object_group_prefix);
  return next != assembly.groups.end() && next->first.starts_with(object_group_prefix);
}

void write_objects(h5::File& file, const Assembly& assembly) {
  std::vector<std::string> names;
  std::vector<std::int64_t> offset = {0}, blocks;
  for (const auto& [name, members] : assembly.groups) {
    if (!name.starts_with(object_group_prefix)) continue;
    names.push_back(name.substr(std::string_view(object_group_prefix).size()));
    blocks.insert(blocks.end(), members.begin(), members.end());
    offset.push_back(std::int64_t(blocks.size()));
  }
  file.write_texts("objects/names", names);
  file.write("objects/offset", offset);
  file.write("objects/blocks", blocks);
}

void write_groups(h5::File& file, const Assembly& assembly) {
  file.make_group("groups");
  if (has_objects(assembly)) write_objects(file, assembly);
  for (const auto& [name, members] : assembly.groups) {
    if (name.starts_with(object_group_prefix)) continue;
    if (name.empty() || name.find('/') != std::string::npos)
      throw InputError("cannot write {}: group \"{}\": the name of a group must not be empty and must not contain '/'",
                       file.path(), name);
    file.write<std::int64_t>("groups/" + name, members);
  }
}

void write_sensors(h5::File& file, const Assembly& assembly) {
  std::vector<std::string> ids;
  std::vector<double> position, direction;
  std::vector<std::int64_t> block;
  for (const Sensor& sensor : assembly.sensors) {
    ids.push_back(sensor.id);
    position.insert(position.end(), sensor.position.data(), sensor.position.data() + 3);
    direction.insert(direction.end(), sensor.direction.data(), sensor.direction.data() + 3);
    block.push_back(sensor.block);
  }
  const std::size_t n = ids.size();
  file.write<double>("sensors/position", position, {n, 3}, "m");
  file.write<double>("sensors/direction", direction, {n, 3});
  file.write<std::int64_t>("sensors/block", block);
  file.set_texts("sensors", "id", ids);
}

}  // namespace

void write_assembly(const std::string& path, const Assembly& assembly) {
  h5::File file = h5::File::create(path);
  file.set_text("/", "format", "voussoir-assembly");
  file.set_integer("/", "format_version", has_objects(assembly) ? assembly_format_version : 2);
  file.set_text("/", "units", "SI");
  file.set_text("/", "generator", assembly.generator);
  file.set_text("/", "program_version", VOUSSOIR_VERSION);
  file.set_text("/", "case", assembly.case_text);
  if (!assembly.effects.empty()) file.set_texts("/", "effects", assembly.effects);
  for (const Table& table : mechanics(assembly))
    std::visit(
        [&](const auto& values) {
          h5::Shape shape = {values.size() / table.columns};
          if (table.columns > 1) shape.push_back(table.columns);
          file.write(table.name, values, shape, table.unit);
        },
        table.values);
  write_names(file, assembly);
  write_groups(file, assembly);
  write_sensors(file, assembly);
  file.save();
}

std::uint64_t assembly_hash(const Assembly& assembly) {
  std::uint64_t hash = hash_text("voussoir-assembly");
  for (const Table& table : mechanics(assembly))
    std::visit(
        [&](const auto& values) {
          hash = hash_bytes(table.name.data(), table.name.size(), hash);
          hash = hash_bytes(values.data(), values.size() * sizeof(values[0]), hash);
        },
        table.values);
  return hash;
}

}  // namespace voussoir

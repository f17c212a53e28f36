// Reading assembly files. Whatever another program may have got wrong is found here, not in the solver.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/stiffness.h"
#include "io/hdf5/assembly_file.h"
#include "io/hdf5/check_patch.h"
#include "io/hdf5/h5.h"
#include "io/hdf5/read_fill.h"
#include "io/hdf5/shape_arrays.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"

namespace voussoir {

namespace {

/// One reading: the file, and the assembly as far as it is known.
class AssemblyReader {
 public:
  explicit AssemblyReader(const std::string& path) : file_(h5::File::open(path)) {}
  Assembly as_stated() { return read_all(), std::move(assembly_); }
  Assembly read_whole(const JointSearch& search);

 private:
  void read_all();
  void read_shapes_of_blocks();
  void read_properties();
  void check_fixed() const;
  void read_materials();
  void materials_from_density();
  void finish();
  void read_stated(const std::string& name, std::size_t columns);
  void read_laws();
  void read_joints();
  std::vector<std::int64_t> read_pairs(std::size_t n) const;
  void find_face(std::size_t row, const Polygon& patch, std::int64_t block, const Vec3& outward, std::int32_t& cell,
                 std::int32_t& face) const;
  void check_joint(std::size_t row, const Joint& joint) const;
  void sort_joints();
  void find_joints(const JointSearch& search);
  void read_groups();
  void read_objects();
  void read_sensors();

  std::vector<std::int32_t> read_words(const std::string& name, std::size_t size,
                                       const std::vector<std::string>& known);
  std::vector<double> read_column(const std::string& name, std::size_t size) const {
    return read_finite(file_, name, {size});
  }
  template <class Integer>
  std::vector<Integer> read_indices(const std::string& name, const h5::Shape& shape, std::int64_t limit) const;
  std::size_t blocks() const { return assembly_.blocks.size(); }

  h5::File file_;
  Assembly assembly_;
};

/// Integers that must lie in [0, limit).
template <class Integer>
std::vector<Integer> AssemblyReader::read_indices(const std::string& name, const h5::Shape& shape,
                                                  std::int64_t limit) const {
  std::vector<Integer> values = file_.read<Integer>(name, shape);
  const std::size_t columns = shape.size() > 1 ? shape[1] : 1;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] < 0 || std::int64_t(values[i]) >= limit)
      file_.fail(name, fmt::format("row {}: {} is out of range, expected 0 to {}", i / columns, values[i], limit - 1));
  return values;
}

/// Numbers of words, translated from the file's own list (attribute `names`) to the program's.
std::vector<std::int32_t> AssemblyReader::read_words(const std::string& name, std::size_t size,
                                                     const std::vector<std::string>& known) {
  const std::vector<std::string> names = file_.has_attribute(name, "names") ? file_.texts(name, "names") : known;
  std::vector<std::int32_t> values = read_indices<std::int32_t>(name, {size}, std::int64_t(names.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& word = names[std::size_t(values[i])];
    const auto at = std::find(known.begin(), known.end(), word);
    if (at == known.end())
      file_.fail(name,
                 fmt::format("row {}: unknown word \"{}\", expected one of: {}", i, word, fmt::join(known, ", ")));
    values[i] = std::int32_t(at - known.begin());
  }
  return values;
}

void AssemblyReader::read_shapes_of_blocks() {
  const ShapeArrays outer = read_shapes(file_, "blocks", "block_face_offset");
  if (outer.size() == 0 && !file_.has("fill/nodes")) file_.fail("blocks/vertex_offset", "there are no blocks");
  assembly_.blocks.resize(outer.size());
  if (file_.has("cells/block")) {
    const ShapeArrays cells = read_shapes(file_, "cells", "cell_face_offset");
    const auto owner = read_indices<std::int64_t>("cells/block", {cells.size()}, std::int64_t(outer.size()));
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (c > 0 && owner[c] < owner[c - 1])
        file_.fail("cells/block",
                   fmt::format("row {}: block {} after block {}: must not decrease", c, owner[c], owner[c - 1]));
      assembly_.blocks[std::size_t(owner[c])].cells.push_back(cells.shape(c));
      if (const std::string fault = find_fault(assembly_.blocks[std::size_t(owner[c])].cells.back()); !fault.empty())
        file_.fail("cells/vertices", fmt::format("cell {} of block {}: {}", c, owner[c], fault));
    }
  }
  for (std::size_t i = 0; i < outer.size(); ++i) {
    auto& cells = assembly_.blocks[i].cells;
    if (!cells.empty()) continue;
    cells.push_back(outer.shape(i));
    if (const std::string fault = find_fault(cells[0]); !fault.empty())
      file_.fail("blocks/vertices", fmt::format("block {}: {}", i, fault));
  }
}

void AssemblyReader::read_properties() {
  const auto component = read_words("blocks/component", blocks(), component_names());
  const auto part = file_.read<std::int32_t>("blocks/part", {blocks()});
  const auto fixed = read_indices<std::uint8_t>("blocks/fixed", {blocks()}, 2);
  for (std::size_t i = 0; i < blocks(); ++i) {
    assembly_.blocks[i].component = Component(component[i]);
    assembly_.blocks[i].part = part[i];
    assembly_.blocks[i].fixed = fixed[i] != 0;
  }
}

void AssemblyReader::check_fixed() const {
  const auto is_fixed = [](const Block& block) { return block.fixed; };
  if (blocks() > 0 && std::none_of(assembly_.blocks.begin(), assembly_.blocks.end(), is_fixed))
    file_.fail("blocks/fixed",
               "no block is fixed. At least one value must be 1, because otherwise all blocks would fall (voussoir "
               "import FILE -o OTHER --fixed lowest sets it).");
}

void AssemblyReader::read_materials() {
  if (!file_.has("materials/density")) return materials_from_density();
  const std::vector<std::string> names = file_.texts("materials", "names");
  const std::size_t n = names.size();
  const auto density = read_column("materials/density", n), e = read_column("materials/youngs_modulus", n),
             g = read_column("materials/shear_modulus", n), ft = read_column("materials/tensile_strength", n),
             c = read_column("materials/cohesion", n), phi = read_column("materials/friction_angle", n);
  const bool dilates = file_.has("materials/dilation_angle");
  const auto psi = dilates ? read_column("materials/dilation_angle", n) : std::vector<double>(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(density[i] > 0.0))
      file_.fail("materials/density",
                 fmt::format("row {} ({}): {} kg/m3, expected more than 0", i, names[i], density[i]));
    if (psi[i] < 0.0 || psi[i] > std::max(phi[i], 0.0))
      file_.fail(
          "materials/dilation_angle",
          fmt::format("row {} ({}): {} rad, expected 0 to the friction angle, {} rad", i, names[i], psi[i], phi[i]));
    assembly_.materials.push_back({names[i], density[i], e[i], g[i], ft[i], c[i], phi[i], psi[i]});
  }
  const auto material = read_indices<std::int32_t>("blocks/material", {blocks()}, std::int64_t(n));
  for (std::size_t i = 0; i < blocks(); ++i) assembly_.blocks[i].material = material[i];
  if (!file_.has("blocks/density")) return;
  const auto stated = read_column("blocks/density", blocks());
  for (std::size_t i = 0; i < blocks(); ++i)
    if (const double own = density[std::size_t(material[i])]; std::abs(stated[i] - own) > 1e-9 * own)
      file_.fail("blocks/density",
                 fmt::format("row {}: {} kg/m3, but its material \"{}\" has {} kg/m3. Make them equal. A block of "
                             "another density needs its own material: a further row in materials/* (and in its "
                             "attribute names), whose number is in blocks/material.",
                             i, stated[i], names[std::size_t(material[i])], own));
}

/// Files of other programs may state densities only: one material for each value that occurs.
void AssemblyReader::materials_from_density() {
  const auto density = read_column("blocks/density", blocks());
  for (std::size_t i = 0; i < blocks(); ++i) {
    if (!(density[i] > 0.0))
      file_.fail("blocks/density", fmt::format("row {}: {} kg/m3, expected more than 0", i, density[i]));
    std::size_t m = 0;
    while (m < assembly_.materials.size() && assembly_.materials[m].density != density[i]) ++m;
    if (m == assembly_.materials.size())
      assembly_.materials.push_back({.name = fmt::format("material {}", m), .density = density[i]});
    assembly_.blocks[i].material = std::int32_t(m);
  }
}

/// Masses from the shapes; values stated in the file must agree, and then their bits are kept.
void AssemblyReader::finish() {
  try {
    finish_blocks(assembly_);
  } catch (const InputError& error) {
    file_.fail("blocks/vertices", error.what());
  }
  read_stated("blocks/mass", 1);
  read_stated("blocks/centroid", 3);
  read_stated("blocks/inertia", 6);
}

void AssemblyReader::read_stated(const std::string& name, std::size_t columns) {
  if (!file_.has(name)) return;
  const auto values = read_finite(file_, name, columns == 1 ? h5::Shape{blocks()} : h5::Shape{blocks(), columns});
  for (std::size_t i = 0; i < blocks(); ++i) {
    Block& block = assembly_.blocks[i];
    const double* v = values.data() + columns * i;
    const Box box = block_box(block);
    const double size = (box.high - box.low).norm();
    double scale = block.mass, error = 0.0;
    if (columns == 1) {
      error = std::abs(v[0] - block.mass);
      block.mass = v[0];
    } else if (columns == 3) {
      const Vec3 centroid(v[0], v[1], v[2]);
      scale = size;
      error = (centroid - block.centroid).norm();
      block.centroid = centroid;
    } else {
      Mat3 inertia;
      inertia << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
      scale *= size * size;
      error = (inertia - block.inertia).norm();
      block.inertia = inertia;
    }
    if (error > 1e-6 * scale)
      file_.fail(name, fmt::format(
                           "row {}: differs by {:.3g} from the value that follows from shape and density of the block. "
                           "Correct it, or leave the dataset out.",
                           i, error));
  }
}

void AssemblyReader::read_laws() {
  const std::size_t n = file_.rows("laws/tension");
  const auto kind = read_words("laws/kind", n, joint_law_kinds());
  const auto tension = read_column("laws/tension", n), cohesion = read_column("laws/cohesion", n),
             friction = read_column("laws/friction_angle", n);
  const auto residual_cohesion = read_column("laws/residual_cohesion", n),
             residual_friction = read_column("laws/residual_friction_angle", n),
             dilation = read_column("laws/dilation_angle", n);
  const auto energy = read_finite(file_, "laws/fracture_energy", {n, 2});
  const auto prestress = file_.has("laws/prestress") ? read_column("laws/prestress", n) : std::vector<double>(n, 0.0);
  // Files without composite joints leave these out.
  const std::pair<const char*, double JointLaw::*> composite[] = {
      {"laws/compressive_strength", &JointLaw::compressive_strength},
      {"laws/compressive_energy", &JointLaw::compressive_energy},
      {"laws/compressive_peak", &JointLaw::compressive_peak},
      {"laws/cap_shear", &JointLaw::cap_shear},
      {"laws/dilation_length", &JointLaw::dilation_length},
      {"laws/dilation_pressure", &JointLaw::dilation_pressure}};
  for (std::size_t i = 0; i < n; ++i) {
    assembly_.laws.push_back({JointLaw::Kind(kind[i]),
                              tension[i],
                              cohesion[i],
                              friction[i],
                              residual_cohesion[i],
                              residual_friction[i],
                              dilation[i],
                              {energy[2 * i], energy[2 * i + 1]},
                              prestress[i],
                              0.0,
                              0.0,
                              0.0,
                              JointLaw{}.cap_shear,
                              0.0,
                              0.0});
    if (tension[i] < 0.0) file_.fail("laws/tension", fmt::format("row {}: {} Pa, expected 0 or more", i, tension[i]));
    if (cohesion[i] < 0.0)
      file_.fail("laws/cohesion", fmt::format("row {}: {} Pa, expected 0 or more", i, cohesion[i]));
    if (friction[i] < 0.0 || friction[i] >= 1.5707)
      file_.fail("laws/friction_angle", fmt::format("row {}: {} rad, expected 0 to 1.57", i, friction[i]));
  }
  for (const auto& [name, member] : composite) {
    if (!file_.has(name)) continue;
    const auto values = read_column(name, n);
    for (std::size_t i = 0; i < n; ++i) {
      if (values[i] < 0.0) file_.fail(name, fmt::format("row {}: {}, expected 0 or more", i, values[i]));
      assembly_.laws[i].*member = values[i];
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    if (const JointLaw& law = assembly_.laws[i]; law.compressive_strength > 0.0 && law.compressive_energy <= 0.0)
      file_.fail("laws/compressive_energy",
                 fmt::format("row {}: {} J/m2, expected above 0 where there is a compressive strength", i,
                             law.compressive_energy));
}

/// For files that do not say which faces meet: the face of a block that looks along the joint, out of it, and is
/// nearest to its middle, in the cell that is nearest to it.
void AssemblyReader::find_face(std::size_t row, const Polygon& patch, std::int64_t block, const Vec3& outward,
                               std::int32_t& cell, std::int32_t& face) const {
  const Vec3 middle = polygon_centroid(patch);
  double least = 1e300;
  const auto& cells = assembly_.blocks[std::size_t(block)].cells;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    double beyond = 0.0;
    for (std::size_t f = 0; f < cells[c].faces.size(); ++f) {
      const Plane plane = face_plane(cells[c], int(f));
      beyond = std::max(beyond, plane.normal.dot(middle) - plane.offset);
    }
    for (std::size_t f = 0; f < cells[c].faces.size(); ++f) {
      const Plane plane = face_plane(cells[c], int(f));
      const double away = beyond + std::abs(plane.normal.dot(middle) - plane.offset);
      if (plane.normal.dot(outward) < 0.99 || away >= least) continue;
      least = away;
      cell = std::int32_t(c);
      face = std::int32_t(f);
    }
  }
  if (least > 0.1) file_.fail("joints/blocks", fmt::format("row {}: block {} has no face at the joint", row, block));
}

void AssemblyReader::check_joint(std::size_t row, const Joint& joint) const {
  const auto fail = [&](const char* name, const std::string& reason) {
    file_.fail(name, fmt::format("row {} (blocks {} and {}): {}", row, joint.a, joint.b, reason));
  };
  if (joint.a == joint.b) fail("joints/blocks", "a joint needs two different blocks");
  if (joint.a > joint.b)
    fail("joints/blocks", "the block with the lower number must come first, and the normal must point to the other");
  check_patch(joint, fail);
  const auto check_face = [&](std::int64_t block, std::int32_t cell, std::int32_t face) {
    const auto& cells = assembly_.blocks[std::size_t(block)].cells;
    if (cell < 0 || cell >= std::int32_t(cells.size()))
      fail("joints/cells", fmt::format("block {} has no cell {}", block, cell));
    if (face < 0 || face >= std::int32_t(cells[std::size_t(cell)].faces.size()))
      fail("joints/faces", fmt::format("cell {} of block {} has no face {}", cell, block, face));
  };
  check_face(joint.a, joint.cell_a, joint.face_a);
  check_face(joint.b, joint.cell_b, joint.face_b);
}

/// The second of the two may be a triangle of the fill's surface: −1 − t for triangle t.
std::vector<std::int64_t> AssemblyReader::read_pairs(std::size_t n) const {
  const std::string name = "joints/blocks";
  const auto pairs = file_.read<std::int64_t>(name, {n, 2});
  const auto last = std::int64_t(blocks()) - 1, lowest = -std::int64_t(assembly_.fill.triangles.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::int64_t least = i % 2 == 1 ? lowest : 0;
    if (pairs[i] > last || pairs[i] < least)
      file_.fail(name, fmt::format("row {}: {} is out of range, expected {} to {}", i / 2, pairs[i], least, last));
  }
  return pairs;
}

void AssemblyReader::read_joints() {
  if (!file_.has("joints/blocks")) return;
  const std::size_t n = file_.rows("joints/blocks");
  const auto between = read_pairs(n);
  const auto corners = read_places(file_, "joints/polygon", h5::any);
  const auto offset = file_.read<std::int64_t>("joints/polygon_offset", {n + 1});
  check_offsets(file_, "joints/polygon_offset", offset, corners.size() / 3);
  const auto normal = read_finite(file_, "joints/normal", {n, 3}), area = read_column("joints/area", n),
             kn = read_column("joints/kn", n), ks = read_column("joints/ks", n);
  const auto law = read_indices<std::int32_t>("joints/law", {n}, std::int64_t(assembly_.laws.size()));
  const bool located = file_.has("joints/cells") && file_.has("joints/faces");
  std::vector<std::int32_t> cells(2 * n), faces(2 * n);
  if (located) {
    cells = file_.read<std::int32_t>("joints/cells", {n, 2});
    faces = file_.read<std::int32_t>("joints/faces", {n, 2});
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t a = between[2 * i], b = between[2 * i + 1];
    const auto common = [&](auto& joint) {
      joint.normal = Eigen::Map<const Vec3>(normal.data() + 3 * i);
      joint.area = area[i], joint.kn = kn[i], joint.ks = ks[i], joint.law = law[i];
      for (std::int64_t k = offset[i]; k < offset[i + 1]; ++k)
        joint.polygon.emplace_back(Eigen::Map<const Vec3>(corners.data() + 3 * k));
      return !located && joint.polygon.size() > 2;
    };
    if (b < 0) {
      FillJoint& joint = assembly_.fill_joints.emplace_back();
      joint.block = a, joint.cell = cells[2 * i], joint.face = faces[2 * i], joint.triangle = std::int32_t(-1 - b);
      if (common(joint)) find_face(i, joint.polygon, joint.block, joint.normal, joint.cell, joint.face);
      check_fill_joint(file_, i, assembly_, joint);
      continue;
    }
    Joint& joint = assembly_.joints.emplace_back();
    joint.a = a, joint.cell_a = cells[2 * i], joint.face_a = faces[2 * i];
    joint.b = b, joint.cell_b = cells[2 * i + 1], joint.face_b = faces[2 * i + 1];
    if (common(joint)) {
      find_face(i, joint.polygon, joint.a, joint.normal, joint.cell_a, joint.face_a);
      find_face(i, joint.polygon, joint.b, -joint.normal, joint.cell_b, joint.face_b);
    }
    check_joint(i, joint);
  }
  sort_joints();
  sort_fill_joints(file_, assembly_.fill_joints);
}

void AssemblyReader::sort_joints() {
  const auto key = [](const Joint& j) {
    return std::array{
        j.a, j.b, std::int64_t(j.cell_a), std::int64_t(j.cell_b), std::int64_t(j.face_a), std::int64_t(j.face_b)};
  };
  auto& joints = assembly_.joints;
  std::stable_sort(joints.begin(), joints.end(), [&](const Joint& x, const Joint& y) { return key(x) < key(y); });
  const auto twice = std::adjacent_find(joints.begin(), joints.end(),
                                        [&](const Joint& x, const Joint& y) { return key(x) == key(y); });
  if (twice != joints.end())
    file_.fail("joints/blocks", fmt::format("the joint between blocks {} and {} (faces {} and {}) is listed twice",
                                            twice->a, twice->b, twice->face_a, twice->face_b));
}

void AssemblyReader::read_groups() {
  for (const std::string& name : file_.names("groups"))
    assembly_.groups[name] = read_indices<std::int64_t>("groups/" + name, {h5::any}, std::int64_t(blocks()));
  if (file_.has("objects/names")) read_objects();
}

void AssemblyReader::read_objects() {
  const std::vector<std::string> names = file_.read_texts("objects/names");
  const auto members = read_indices<std::int64_t>("objects/blocks", {h5::any}, std::int64_t(blocks()));
  const auto offset =
      read_indices<std::int64_t>("objects/offset", {names.size() + 1}, std::int64_t(members.size()) + 1);
  if (!std::is_sorted(offset.begin(), offset.end()) || offset.front() != 0 ||
      offset.back() != std::int64_t(members.size()))
    file_.fail("objects/offset",
               fmt::format("it must rise from 0 to {}, the number of objects/blocks", members.size()));
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!assembly_.groups
             .try_emplace(object_group_prefix + names[i], members.begin() + offset[i], members.begin() + offset[i + 1])
             .second)
      file_.fail("objects/names", fmt::format("\"{}\" is given twice, or is also a group", shown(names[i])));
}

void AssemblyReader::read_sensors() {
  if (!file_.has("sensors/position")) return;
  const std::vector<std::string> ids = file_.texts("sensors", "id");
  const std::size_t n = ids.size();
  const auto position = read_places(file_, "sensors/position", n),
             direction = read_finite(file_, "sensors/direction", {n, 3});
  const auto block = read_indices<std::int64_t>("sensors/block", {n}, std::int64_t(blocks()));
  for (std::size_t i = 0; i < n; ++i)
    assembly_.sensors.push_back({ids[i], Eigen::Map<const Vec3>(position.data() + 3 * i),
                                 Eigen::Map<const Vec3>(direction.data() + 3 * i), block[i]});
}

/// Finds the joints if the file has none.
void AssemblyReader::find_joints(const JointSearch& search) {
  if (blocks() == 0) return;
  if (!assembly_.laws.empty())
    file_.fail("laws/tension", "there are laws, but no joints/blocks that have them. Give joints, or no laws.");
  if (!assembly_.fill.empty())
    file_.fail("joints/blocks",
               "the dataset is missing, and the program does not find patches between stones and fill when it reads a "
               "file. Write the stones alone, and add the fill with voussoir import FILL.msh --into FILE -o OTHER.");
  try {
    lay_joints(assembly_, search);
  } catch (const InputError& error) {
    file_.fail("joints/blocks",
               fmt::format("the dataset is missing, so the program looks for joints: {} The command voussoir import "
                           "FILE -o OTHER finds them with moduli, strengths and gap of its options.",
                           error.what()));
  }
}

Assembly AssemblyReader::read_whole(const JointSearch& search) {
  read_all();
  check_fixed();
  if (!file_.has("joints/blocks")) find_joints(search);
  return std::move(assembly_);
}

void AssemblyReader::read_all() {
  h5::check_format(file_, "voussoir-assembly", assembly_format_version);
  if (file_.has_attribute("/", "units") && file_.text("/", "units") != "SI")
    file_.fail("/", "the attribute 'units' is \"" + file_.text("/", "units") + "\", expected \"SI\": convert the file");
  if (file_.has_attribute("/", "generator")) assembly_.generator = file_.text("/", "generator");
  if (file_.has_attribute("/", "case")) assembly_.case_text = file_.text("/", "case");
  if (file_.has_attribute("/", "effects")) assembly_.effects = file_.texts("/", "effects");
  read_shapes_of_blocks();
  read_properties();
  read_materials();
  finish();
  if (file_.has("laws/tension")) read_laws();
  assembly_.fill = read_fill(file_, assembly_.materials.size());
  read_joints();
  read_groups();
  read_sensors();
}

}  // namespace

Assembly read_assembly(const std::string& path, const JointSearch& search) {
  return AssemblyReader(path).read_whole(search);
}

Assembly read_stated_assembly(const std::string& path) {
  return AssemblyReader(path).as_stated();
}

bool states_joints(const std::string& path) {
  return h5::File::open(path).has("joints/blocks");
}

}  // namespace voussoir

// Assembly files: exact round trips, and refusals that name dataset and row.
#include "io/hdf5/assembly_file.h"

#include <gtest/gtest.h>

#include "geometry/generator.h"
#include "geometry/joint_counts.h"
#include "geometry/joints.h"
#include "io/hdf5/h5.h"
#include "io/hdf5/shape_arrays.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;

/// Two boxes on a fixed one; the second is made of two cells, an L.
Assembly small_assembly() {
  Assembly assembly;
  assembly.generator = "test";
  assembly.case_text = std::string(100000, 'c') + "\n# ü";
  assembly.materials = {{"stone", 2000.0, 4e9, 1.6e9, 1e5, 2e5, 0.5}, {"fill", 1500.0, 4e8, 1.6e8, 0.0, 2e4, 0.7}};
  assembly.laws = {{}, {JointLaw::Kind::softening, 1e5, 2e5, 0.5, 1e3, 0.4, 0.1, {50.0, 100.0}}};
  Block base, one, two;
  base.cells = {make_box({0, 0, -1}, {4, 1, 0})};
  base.component = Component::base;
  base.fixed = true;
  one.cells = {make_box({0, 0, 0}, {1.0 / 3.0, 1, 1})};
  one.component = Component::pier;
  one.part = 2;
  two.cells = {make_box({1, 0, 0}, {2, 1, 1}), make_box({2, 0, 0}, {3, 1, 0.5})};
  two.component = Component::backfill;
  two.material = 1;
  assembly.blocks = {base, one, two};
  finish_blocks(assembly);
  find_joints(assembly);
  for (Joint& joint : assembly.joints) {
    joint.kn = 1e9 / 3.0;
    joint.ks = 4e8;
    joint.law = 1;
  }
  assembly.groups = {{"keystone 0", {1}}, {"none", {}}, {"wall y- pier 1", {1, 2}}};
  assembly.sensors = {{"a1", {0.1, 0.2, 1.0}, {0, 0, 1}, 1}};
  return assembly;
}

void expect_equal(const Block& a, const Block& b) {
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t c = 0; c < a.cells.size(); ++c) {
    EXPECT_EQ(a.cells[c].vertices, b.cells[c].vertices);
    EXPECT_EQ(a.cells[c].faces, b.cells[c].faces);
  }
  EXPECT_EQ(a.component, b.component);
  EXPECT_EQ(a.part, b.part);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.fixed, b.fixed);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.centroid, b.centroid);
  EXPECT_EQ(a.inertia, b.inertia);
}

void expect_equal(const Joint& a, const Joint& b) {
  EXPECT_EQ(a.a, b.a);
  EXPECT_EQ(a.b, b.b);
  EXPECT_EQ(a.cell_b, b.cell_b);
  EXPECT_EQ(a.face_a, b.face_a);
  EXPECT_EQ(a.face_b, b.face_b);
  EXPECT_EQ(a.polygon, b.polygon);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.area, b.area);
  EXPECT_EQ(a.kn, b.kn);
  EXPECT_EQ(a.ks, b.ks);
  EXPECT_EQ(a.law, b.law);
}

/// Only an assembly that has such joints stores what they are made of: files of others stay as they were.
TEST(AssemblyFile, KeepsCompositeLaws) {
  const Folder folder;
  Assembly out = small_assembly();
  write_assembly(folder / "plain.h5", out);
  EXPECT_FALSE(h5::File::open(folder / "plain.h5").has("laws/cap_shear"));
  JointLaw law = out.laws[1];
  law.kind = JointLaw::Kind::composite;
  law.compressive_strength = 9e6, law.compressive_energy = 2e4, law.compressive_peak = 1e-3;
  law.cap_shear = 4.0, law.dilation_length = 2e-3, law.dilation_pressure = 1e6;
  out.laws.push_back(law);
  write_assembly(folder / "a.h5", out);
  EXPECT_EQ(read_assembly(folder / "a.h5").laws, out.laws);
}

TEST(AssemblyFile, RoundTripIsExact) {
  const Folder folder;
  const Assembly out = small_assembly();
  write_assembly(folder / "a.h5", out);
  const Assembly in = read_assembly(folder / "a.h5");
  EXPECT_EQ(in.generator, out.generator);
  EXPECT_EQ(in.case_text, out.case_text);
  ASSERT_EQ(in.blocks.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) expect_equal(in.blocks[i], out.blocks[i]);
  ASSERT_EQ(in.joints.size(), out.joints.size());
  ASSERT_EQ(in.joints.size(), 3u);
  for (std::size_t i = 0; i < in.joints.size(); ++i) expect_equal(in.joints[i], out.joints[i]);
  EXPECT_EQ(in.laws, out.laws);
  EXPECT_EQ(in.groups, out.groups);
  ASSERT_EQ(in.materials.size(), 2u);
  EXPECT_EQ(in.materials[1].name, "fill");
  EXPECT_EQ(in.materials[1].friction_angle, 0.7);
  ASSERT_EQ(in.sensors.size(), 1u);
  EXPECT_EQ(in.sensors[0].id, "a1");
  EXPECT_EQ(in.sensors[0].position, out.sensors[0].position);
  EXPECT_EQ(assembly_hash(in), assembly_hash(out));
  write_assembly(folder / "b.h5", in);
  EXPECT_EQ(test::bytes_of(folder / "b.h5"), test::bytes_of(folder / "a.h5"));  // and the files are equal
}

TEST(AssemblyFile, EveryGeneratorSurvives) {
  for (const Generator& generator : generators()) {
    if (generator.name.starts_with("cs")) continue;  // large; the same code
    const Folder folder;
    const Assembly out = generator.build(default_input(generator));
    write_assembly(folder / "a.h5", out);
    EXPECT_EQ(assembly_hash(read_assembly(folder / "a.h5")), assembly_hash(out)) << generator.name;
  }
}

TEST(AssemblyFile, HashSeesWhatMoves) {
  const Assembly assembly = small_assembly();
  Assembly other = assembly;
  other.joints[0].kn *= 1.0 + 1e-15;
  EXPECT_NE(assembly_hash(other), assembly_hash(assembly));
  other = assembly;
  other.generator = "another";
  EXPECT_EQ(assembly_hash(other), assembly_hash(assembly));
}

TEST(AssemblyFile, BoundaryOfABlockOfTwoCells) {
  const Folder folder;
  write_assembly(folder / "a.h5", small_assembly());
  const h5::File file = h5::File::open(folder / "a.h5");
  EXPECT_EQ(file.shape("cells/block"), h5::Shape{2});
  EXPECT_EQ(file.unit("blocks/vertices"), "m");
  EXPECT_EQ(file.texts("blocks/component", "names").at(2), "abutment");
  // The loops of the L enclose its volume: the shared face is not among them.
  Polyhedron shape;
  const auto vertices = file.read<double>("blocks/vertices", {h5::any, 3});
  const auto offset = file.read<std::int64_t>("blocks/vertex_offset"),
             loops = file.read<std::int64_t>("blocks/face_vertices"),
             face = file.read<std::int64_t>("blocks/face_offset"),
             of_block = file.read<std::int64_t>("blocks/block_face_offset");
  for (auto v = offset[2]; v < offset[3]; ++v)
    shape.vertices.emplace_back(vertices[std::size_t(3 * v)], vertices[std::size_t(3 * v + 1)],
                                vertices[std::size_t(3 * v + 2)]);
  for (auto f = of_block[2]; f < of_block[3]; ++f)
    shape.faces.emplace_back(loops.begin() + face[std::size_t(f)], loops.begin() + face[std::size_t(f) + 1]);
  EXPECT_NEAR(mass_properties(shape).volume, 1.5, 1e-12);
  EXPECT_NEAR(surface_area(shape), 2 * 1.5 + 2 * (1.0 + 1.0) + 2.0 * 1.0, 1e-12);
}

/// Rewrites an assembly file with one dataset changed (or left out, when the change returns false).
template <class T>
std::string changed(const Folder& folder, const std::string& name, const std::function<bool(std::vector<T>&)>& change) {
  write_assembly(folder / "a.h5", small_assembly());
  const h5::File from = h5::File::open(folder / "a.h5");
  h5::File to = h5::File::create(folder / "changed.h5");
  to.set_text("/", "format", "voussoir-assembly");
  to.set_integer("/", "format_version", 1);
  const auto copy = [&](auto tag, const std::string& path) {
    using U = decltype(tag);
    auto values = from.read<U>(path, h5::Shape(from.shape(path).size(), h5::any));
    h5::Shape shape = from.shape(path);
    if constexpr (std::same_as<T, U>)
      if (path == name) {
        if (!change(values)) return;
        std::size_t row = 1;
        for (std::size_t i = 1; i < shape.size(); ++i) row *= shape[i];
        shape[0] = values.size() / row;
      }
    to.write<U>(path, values, shape);
  };
  const std::vector<std::string> bytes = {"blocks/fixed"},
                                 ints = {"blocks/component", "blocks/part", "blocks/material", "joints/cells",
                                         "joints/faces",     "joints/law",  "laws/kind"};
  for (const std::string& path : from.datasets()) {
    const auto in = [&](const std::vector<std::string>& list) {
      return std::find(list.begin(), list.end(), path) != list.end();
    };
    const bool index = path.ends_with("offset") || path.ends_with("face_vertices") || path.ends_with("/block") ||
                       path.ends_with("blocks") || path.starts_with("groups/");
    if (in(bytes))
      copy(std::uint8_t{}, path);
    else if (in(ints))
      copy(std::int32_t{}, path);
    else if (index)
      copy(std::int64_t{}, path);
    else
      copy(double{}, path);
  }
  if (to.has("materials")) to.set_texts("materials", "names", {"stone", "fill"});
  to.set_texts("sensors", "id", {"a1"});
  to.save();
  return folder / "changed.h5";
}

template <class T>
std::string refusal(const std::string& name, const std::function<void(std::vector<T>&)>& change) {
  const Folder folder;
  const std::string path = changed<T>(folder, name, [&](std::vector<T>& values) { return change(values), true; });
  const std::string message = test::message_of<InputError>([&] { read_assembly(path); });
  EXPECT_TRUE(message.starts_with(path)) << message;
  return message;
}

bool holds(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

/// The copy is of version 1: that of files from before there was a fill.
TEST(AssemblyFile, CopyWithoutChangesIsAccepted) {
  const Folder folder;
  const std::string path = changed<double>(folder, "blocks/mass", [](auto&) { return true; });
  EXPECT_EQ(assembly_hash(read_assembly(path)), assembly_hash(small_assembly()));
}

TEST(AssemblyFile, OptionalDatasetsMayBeAbsent) {
  const Folder folder;
  const Assembly whole = small_assembly();
  for (const char* name : {"blocks/mass", "blocks/inertia", "blocks/density"}) {
    const Assembly in = read_assembly(changed<double>(folder, name, [](auto&) { return false; }));
    expect_equal(in.blocks[1], whole.blocks[1]);
  }
  // Faces are found again from the geometry.
  const Assembly in = read_assembly(changed<std::int32_t>(folder, "joints/faces", [](auto&) { return false; }));
  for (std::size_t i = 0; i < in.joints.size(); ++i) expect_equal(in.joints[i], whole.joints[i]);
}

TEST(AssemblyFile, RefusesBadShapes) {
  using Index = std::vector<std::int64_t>;
  EXPECT_TRUE(holds(refusal<double>("blocks/vertices", [](auto& v) { v[7] = NAN; }),
                    "blocks/vertices: row 2: nan is not a finite"));
  EXPECT_TRUE(holds(refusal<double>("blocks/vertices", [](auto& v) { v[7] = 1e200; }),
                    "blocks/vertices: row 2: 1e+200 m, expected coordinates up to 1e+07 m"));
  EXPECT_TRUE(holds(refusal<std::int64_t>("blocks/vertex_offset", [](Index& v) { v[1] = 99; }),
                    "blocks/vertex_offset: row 2: offset 16 is less than"));
  EXPECT_TRUE(
      holds(refusal<std::int64_t>("blocks/vertex_offset", [](Index& v) { v[0] = 1; }), "the first offset must be 0"));
  EXPECT_TRUE(
      holds(refusal<std::int64_t>("blocks/face_offset", [](Index& v) { v.back() += 1; }), "the last offset is"));
  EXPECT_TRUE(holds(refusal<std::int64_t>("blocks/face_vertices", [](Index& v) { v[5] = 8; }),
                    "blocks/face_vertices: row 5: vertex 8 is out of range: shape 0 has 8 vertices"));
  EXPECT_TRUE(
      holds(refusal<std::int64_t>("blocks/face_vertices", [](Index& v) { std::reverse(v.begin(), v.begin() + 24); }),
            "inside-out"));
  EXPECT_TRUE(
      holds(refusal<std::int64_t>("blocks/face_vertices", [](Index& v) { std::reverse(v.begin(), v.begin() + 4); }),
            "block 0: its faces do not close it"));
  EXPECT_TRUE(holds(refusal<double>("blocks/vertices",
                                    [](auto& v) {
                                      for (std::size_t i = 2; i < 24; i += 3) v[i] = 0.0;
                                    }),
                    "block 0"));
  EXPECT_TRUE(holds(refusal<double>("cells/vertices", [](auto& v) { v[0] = INFINITY; }), "cells/vertices: row 0"));
}

TEST(AssemblyFile, RefusesBadProperties) {
  EXPECT_TRUE(holds(refusal<std::uint8_t>("blocks/fixed",
                                          [](auto& v) {
                                            v = {0, 0, 0};
                                          }),
                    "blocks/fixed: no block is fixed"));
  EXPECT_TRUE(holds(refusal<std::int32_t>("blocks/component", [](auto& v) { v[1] = 40; }),
                    "blocks/component: row 1: 40 is out of range"));
  EXPECT_TRUE(holds(refusal<std::int32_t>("blocks/material", [](auto& v) { v[2] = -1; }),
                    "blocks/material: row 2: -1 is out of range"));
  EXPECT_TRUE(holds(refusal<double>("blocks/density", [](auto& v) { v[1] = 1.0; }),
                    "blocks/density: row 1: 1 kg/m3, but its material"));
  EXPECT_TRUE(holds(refusal<double>("blocks/mass", [](auto& v) { v[1] *= 1.001; }), "blocks/mass: row 1: differs"));
  EXPECT_TRUE(holds(refusal<double>("materials/density", [](auto& v) { v[0] = 0.0; }),
                    "materials/density: row 0 (stone): 0 kg/m3"));
}

TEST(AssemblyFile, RefusesBadJoints) {
  EXPECT_TRUE(holds(refusal<double>("joints/kn", [](auto& v) { v[1] = 0.0; }),
                    "joints/kn: row 1 (blocks 0 and 2): 0 Pa/m, expected more than 0"));
  EXPECT_TRUE(holds(refusal<double>("joints/ks", [](auto& v) { v[0] = -2.0; }), "joints/ks: row 0"));
  EXPECT_TRUE(
      holds(refusal<std::int64_t>("joints/blocks", [](auto& v) { v[1] = 0; }), "a joint needs two different blocks"));
  EXPECT_TRUE(holds(refusal<std::int64_t>("joints/blocks", [](auto& v) { v[3] = 3; }),
                    "joints/blocks: row 1: 3 is out of range"));
  EXPECT_TRUE(holds(refusal<std::int64_t>("joints/blocks", [](auto& v) { std::swap(v[0], v[1]); }),
                    "the block with the lower number must come first"));
  EXPECT_TRUE(holds(refusal<std::int32_t>("joints/law", [](auto& v) { v[2] = 2; }),
                    "joints/law: row 2: 2 is out of range, expected 0 to 1"));
  EXPECT_TRUE(
      holds(refusal<std::int32_t>("joints/faces", [](auto& v) { v[0] = 6; }), "cell 0 of block 0 has no face 6"));
  EXPECT_TRUE(holds(refusal<double>("joints/normal", [](auto& v) { v[2] = 2.0; }), "joints/normal: row 0"));
  EXPECT_TRUE(
      holds(refusal<double>("joints/normal", [](auto& v) { v[2] = -v[2]; }), "counter-clockwise about the normal"));
  EXPECT_TRUE(holds(refusal<double>("joints/area", [](auto& v) { v[0] = 7.0; }), "joints/area: row 0"));
  EXPECT_TRUE(
      holds(refusal<double>("joints/kn", [](auto& v) { v.pop_back(); }), "joints/kn: its shape is 2, expected 3"));
}

TEST(AssemblyFile, RefusesOtherFiles) {
  const Folder folder;
  const auto message = [&](const std::string& path) {
    return test::message_of<InputError>([&] { read_assembly(path); });
  };
  EXPECT_TRUE(holds(message(folder / "none.h5"), "none.h5: there is no such file"));
  EXPECT_TRUE(holds(message(folder.write("text.h5", "solid cube\n")), "is not an HDF5 file"));
  EXPECT_TRUE(holds(message(folder.path()), "it is a folder"));
  h5::File foreign = h5::File::create(folder / "foreign.h5");
  foreign.write<double>("x", std::vector<double>{1.0});
  foreign.save();
  EXPECT_TRUE(holds(message(folder / "foreign.h5"), "without the attribute 'format'"));
  h5::File newer = h5::File::create(folder / "newer.h5");
  newer.set_text("/", "format", "voussoir-assembly");
  newer.set_integer("/", "format_version", 4);
  newer.save();
  EXPECT_TRUE(holds(message(folder / "newer.h5"), "format_version 4, this program reads 1 to 3"));
  write_assembly(folder / "a.h5", small_assembly());
  const std::string bytes = test::bytes_of(folder / "a.h5");
  test::set_bytes(folder / "cut.h5", bytes.substr(0, bytes.size() / 2));
  EXPECT_TRUE(holds(message(folder / "cut.h5"), "truncated or damaged"));
}

TEST(AssemblyFile, DamageNeverPassesForAnotherAssembly) {
  const Folder folder;
  const Generator& generator = find_generator("column");
  GeneratorInput input = default_input(generator);
  input.values["blocks"] = 2;
  const Assembly assembly = generator.build(input);
  write_assembly(folder / "a.h5", assembly);
  const std::uint64_t hash = assembly_hash(assembly);
  const std::string bytes = test::bytes_of(folder / "a.h5");
  for (std::size_t at = 0; at < bytes.size(); at += 17) {
    std::string broken = bytes;
    broken[at] = char(broken[at] ^ 0x20);
    test::set_bytes(folder / "b.h5", broken);
    try {
      EXPECT_EQ(assembly_hash(read_assembly(folder / "b.h5")), hash) << "byte " << at;
    } catch (const InputError&) {
    }
  }
}

/// What another program writes: three boxes in a pile, the lowest fixed; of materials and joints what is asked for.
struct Pile {
  std::vector<double> density = {1600.0, 1600.0, 2700.0};
  bool materials = true, laws = false;
  double youngs = 4e9;
};

std::string write_pile(const Folder& folder, const Pile& pile) {
  h5::File file = h5::File::create(folder / "pile.h5");
  file.set_text("/", "format", "voussoir-assembly");
  file.set_integer("/", "format_version", 2);
  ShapeArrays arrays;
  for (int i = 0; i < 3; ++i) arrays.add(make_box({0, 0, 0.5 * i}, {1, 1, 0.5 * (i + 1)}));
  file.write<double>("blocks/vertices", arrays.vertices, {arrays.vertices.size() / 3, 3});
  file.write<std::int64_t>("blocks/vertex_offset", arrays.vertex_offset);
  file.write<std::int64_t>("blocks/face_vertices", arrays.face_vertices);
  file.write<std::int64_t>("blocks/face_offset", arrays.face_offset);
  file.write<std::int64_t>("blocks/block_face_offset", arrays.shape_face_offset);
  file.write<std::int32_t>("blocks/component", {11, 11, 11});
  file.write<std::int32_t>("blocks/part", {0, 0, 0});
  file.write<std::uint8_t>("blocks/fixed", {1, 0, 0});
  file.write<double>("blocks/density", pile.density);
  if (pile.materials) {
    const auto column = [&](const char* name, double light, double heavy) {
      file.write<double>(std::string("materials/") + name, {light, heavy});
    };
    column("density", 1600.0, 2700.0);
    column("youngs_modulus", pile.youngs, pile.youngs);
    column("shear_modulus", 1.6e9, 1.6e9);
    column("tensile_strength", 1e5, 0.0);
    column("cohesion", 2e5, 0.0);
    column("friction_angle", 0.6, 0.5);
    file.set_texts("materials", "names", {"light", "heavy"});
    file.write<std::int32_t>("blocks/material", {0, 0, 1});
  }
  if (pile.laws) {
    for (const char* name :
         {"tension", "cohesion", "friction_angle", "residual_cohesion", "residual_friction_angle", "dilation_angle"})
      file.write<double>(std::string("laws/") + name, {0.5});
    file.write<double>("laws/fracture_energy", {0.0, 0.0}, {1, 2});
    file.write<std::int32_t>("laws/kind", {0});
  }
  file.save();
  return folder / "pile.h5";
}

/// A file that states no joints has them found, with the strengths of its materials.
TEST(AssemblyFile, JointsThatAreNotStatedAreFound) {
  const Folder folder;
  const std::string path = write_pile(folder, {});
  EXPECT_FALSE(states_joints(path));
  const Assembly in = read_assembly(path);
  ASSERT_EQ(in.joints.size(), 2u);
  EXPECT_NEAR(in.joints[0].area, 1.0, 1e-12);
  EXPECT_NEAR(in.joints[0].kn, 4e9 / 0.5, 1.0);
  EXPECT_EQ(in.laws.at(std::size_t(in.joints[0].law)).tension, 1e5);  // light on light
  EXPECT_EQ(in.laws.at(std::size_t(in.joints[1].law)).tension, 0.0);  // the weaker of the two
  EXPECT_EQ(in.laws.at(std::size_t(in.joints[1].law)).friction_angle, 0.5);
  const JointCounts counts = count_joints(in);
  EXPECT_EQ(counts.bonded, 1);
  EXPECT_EQ(counts.dry, 1);
  EXPECT_EQ(joints_text(in), "2 joints: 1 bonded, 1 dry");
  EXPECT_TRUE(read_stated_assembly(path).joints.empty());
  write_assembly(folder / "whole.h5", in);
  EXPECT_TRUE(states_joints(folder / "whole.h5"));
  EXPECT_EQ(assembly_hash(read_assembly(folder / "whole.h5")), assembly_hash(in));
}

TEST(AssemblyFile, JointsThatCannotBeFoundAreAnError) {
  const auto refused = [](const Pile& pile, const std::vector<std::string>& pieces) {
    const Folder folder;
    const std::string path = write_pile(folder, pile);
    const std::string message = test::message_of<InputError>([&] { read_assembly(path); });
    EXPECT_TRUE(message.starts_with(path)) << message;
    for (const std::string& piece : pieces) EXPECT_TRUE(holds(message, piece)) << message;
  };
  refused({.materials = false},
          {"joints/blocks", "2 blocks have no moduli, so their joints have no stiffness. Give kn and ks, or materials",
           "The blocks are: block 1 (block, part 0), material \"material 0\"; block 2"});
  refused({.youngs = 0.0}, {"blocks have no moduli", "material \"light\""});
  refused({.laws = true}, {"laws/tension", "no joints/blocks"});
  refused({.density = {1600.0, 2000.0, 2700.0}}, {"blocks/density: row 1", "a further row in materials/*"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir

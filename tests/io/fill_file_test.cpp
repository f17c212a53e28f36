// A deformable fill in an assembly file: exact round trips, and refusals that name dataset and row.
#include <gtest/gtest.h>

#include "geometry/fill_import.h"
#include "geometry/fill_mesh.h"
#include "geometry/generator.h"
#include "io/case/case.h"
#include "io/hdf5/assembly_file.h"
#include "io/hdf5/h5.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;

/// Two tetrahedra on a fixed stone, with patches.
Assembly filled() {
  Assembly assembly;
  assembly.generator = "test";
  assembly.materials = {{"stone", 2000.0, 4e9, 1.6e9, 1e5, 2e5, 0.5}, {"fill", 1500.0, 4e8, 1.6e8, 0.0, 2e4, 0.7, 0.1}};
  Block base;
  base.cells = {make_box({-1, -1, -1}, {2, 2, 0})};
  base.fixed = true;
  assembly.blocks = {base};
  finish_blocks(assembly);
  FillMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1.0 / 3.0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  orient_tets(mesh);
  find_surface(mesh);
  put_fill(assembly, mesh, 1, {});
  return assembly;
}

void expect_equal(const FillJoint& a, const FillJoint& b) {
  EXPECT_EQ(a.block, b.block);
  EXPECT_EQ(a.cell, b.cell);
  EXPECT_EQ(a.face, b.face);
  EXPECT_EQ(a.triangle, b.triangle);
  EXPECT_EQ(a.polygon, b.polygon);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.area, b.area);
  EXPECT_EQ(a.kn, b.kn);
  EXPECT_EQ(a.ks, b.ks);
  EXPECT_EQ(a.law, b.law);
}

void expect_round_trip(const Assembly& out) {
  const Folder folder;
  write_assembly(folder / "a.h5", out);
  const Assembly in = read_assembly(folder / "a.h5");
  EXPECT_EQ(in.fill.nodes, out.fill.nodes);
  EXPECT_EQ(in.fill.tets, out.fill.tets);
  EXPECT_EQ(in.fill.triangles, out.fill.triangles);
  EXPECT_EQ(in.fill.material, out.fill.material);
  ASSERT_EQ(in.fill_joints.size(), out.fill_joints.size());
  for (std::size_t i = 0; i < in.fill_joints.size(); ++i) expect_equal(in.fill_joints[i], out.fill_joints[i]);
  ASSERT_EQ(in.joints.size(), out.joints.size());
  ASSERT_EQ(in.materials.size(), out.materials.size());
  for (std::size_t i = 0; i < in.materials.size(); ++i)
    EXPECT_EQ(in.materials[i].dilation_angle, out.materials[i].dilation_angle);
  EXPECT_EQ(assembly_hash(in), assembly_hash(out));
  write_assembly(folder / "b.h5", in);
  EXPECT_EQ(test::bytes_of(folder / "b.h5"), test::bytes_of(folder / "a.h5"));
}

TEST(FillFile, RoundTripIsExact) {
  const Assembly out = filled();
  ASSERT_EQ(out.fill_joints.size(), 1u);
  expect_round_trip(out);
}

TEST(FillFile, ABridgeSurvives) {
  GeneratorInput input = default_input(find_generator("cs1"));
  input.values["spans"] = 1.0;
  input.values["fill_edge"] = 1.5;
  input.values["block_scale"] = 3.0;
  input.choices["backfill"] = "deformable";
  expect_round_trip(find_generator("cs1").build(input));
}

TEST(FillFile, AFillAloneNeedsNoBlocks) {
  Assembly alone;
  alone.generator = "import";
  alone.materials = {{"fill", 1500.0, 4e8, 1.6e8, 0.0, 2e4, 0.7}};
  FillMesh mesh = filled().fill;
  mesh.material = {0, 0};
  put_fill(alone, mesh, 0, {});
  expect_round_trip(alone);
}

TEST(FillFile, Layout) {
  const Folder folder;
  const Assembly out = filled();
  write_assembly(folder / "a.h5", out);
  const h5::File file = h5::File::open(folder / "a.h5");
  EXPECT_EQ(file.integer("/", "format_version"), 2);
  EXPECT_EQ(file.shape("fill/nodes"), (h5::Shape{5, 3}));
  EXPECT_EQ(file.shape("fill/tets"), (h5::Shape{2, 4}));
  EXPECT_EQ(file.shape("fill/triangles"), (h5::Shape{6, 3}));
  EXPECT_EQ(file.unit("fill/nodes"), "m");
  const auto blocks = file.read<std::int64_t>("joints/blocks", {h5::any, 2});
  EXPECT_EQ(blocks, (std::vector<std::int64_t>{0, -1 - std::int64_t(out.fill_joints[0].triangle)}));
}

/// What the hash of an assembly without a fill was before there were any, it stays.
TEST(FillFile, AnAssemblyWithoutAFillHasNoTrailOfIt) {
  const Folder folder;
  const Generator& column = find_generator("column");
  write_assembly(folder / "a.h5", column.build(default_input(column)));
  const h5::File file = h5::File::open(folder / "a.h5");
  EXPECT_FALSE(file.has("fill/nodes"));
  EXPECT_FALSE(file.has("materials/dilation_angle"));
}

/// Writing checks nothing; reading does.
std::string refusal(const std::function<void(Assembly&)>& change) {
  const Folder folder;
  Assembly assembly = filled();
  change(assembly);
  write_assembly(folder / "a.h5", assembly);
  const std::string message = test::message_of<InputError>([&] { read_assembly(folder / "a.h5"); });
  EXPECT_TRUE(message.starts_with(folder / "a.h5")) << message;
  return message;
}

bool holds(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

TEST(FillFile, RefusesABadMesh) {
  EXPECT_TRUE(holds(refusal([](Assembly& a) { std::swap(a.fill.tets[1][0], a.fill.tets[1][1]); }),
                    "fill/tets: tetrahedron 1 at"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.fill.tets[1][3] = 5; }),
                    "fill/tets: row 1: node 5 is out of range, expected 0 to 4"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.fill.nodes[2].z() = NAN; }), "fill/nodes: row 2: nan is not a finite"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.fill.nodes.emplace_back(3, 3, 3); }), "belongs to no tetrahedron"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.fill.material[1] = 2; }), "fill/material: row 1: 2 is out of range"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.fill.material.pop_back(); }), "fill/material"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.fill.triangles.pop_back(); }),
                    "fill/triangles: 5 triangles, but the surface has 6"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { std::swap(a.fill.triangles[3][0], a.fill.triangles[3][1]); }),
                    "fill/triangles: row 3: nodes"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.fill.triangles[3] = a.fill.triangles[2]; }), "is listed twice"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.materials[1].dilation_angle = 0.8; }),
                    "materials/dilation_angle: row 1 (fill): 0.8 rad"));
}

TEST(FillFile, RefusesBadPatches) {
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.fill_joints[0].triangle = 6; }),
                    "joints/blocks: row 0: -7 is out of range, expected -6 to 0"));
  EXPECT_TRUE(
      holds(refusal([](Assembly& a) { a.fill_joints[0].triangle = (a.fill_joints[0].triangle + 1) % 6; }), "joints/"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.fill_joints[0].kn = 0.0; }), "joints/kn: row 0 (block 0 and triangle"));
  EXPECT_TRUE(
      holds(refusal([](Assembly& a) { a.fill_joints[0].normal *= -1.0; }), "counter-clockwise about the normal"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.fill_joints[0].area *= 2.0; }), "joints/area: row 0"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.fill_joints[0].face = 9; }), "cell 0 of block 0 has no face 9"));
  EXPECT_TRUE(holds(refusal([](Assembly& a) { a.fill_joints.push_back(a.fill_joints[0]); }), "is listed twice"));
}

TEST(FillFile, ACaseSaysHowAMaterialDilates) {
  const std::string head = "[bridge]\ngenerator = \"cs1\"\n[materials.backfill]\n";
  const Case c = parse_case(head + "dilation_angle = 12.5\n", "c.toml", CaseUse::geometry);
  EXPECT_NEAR(c.generator_input.materials.at("backfill").dilation_angle, 12.5 * 3.14159265358979 / 180.0, 1e-12);
  const Case copy = parse_case(resolved_text(c), "c.toml", CaseUse::geometry);
  EXPECT_EQ(copy.generator_input.materials.at("backfill").dilation_angle,
            c.generator_input.materials.at("backfill").dilation_angle);
  EXPECT_EQ(copy.hash, c.hash);
  const std::string message = test::message_of<InputError>(
      [&] { parse_case(head + "friction_angle = 10\ndilation_angle = 12.5\n", "c.toml", CaseUse::geometry); });
  EXPECT_TRUE(holds(message, "c.toml:5: 'dilation_angle'")) << message;
  EXPECT_TRUE(holds(message, "must not be larger than the friction angle, 10")) << message;
}

TEST(FillFile, OverridesOfACaseReachThePatches) {
  const Folder folder;
  Assembly stored = filled();
  stored.blocks[0].fixed = true;
  write_assembly(folder / "a.h5", stored);
  const Case c =
      parse_case("[bridge]\nassembly = \"a.h5\"\n[joints.fill-fill]\nkn = 7e8\n", folder / "c.toml", CaseUse::geometry);
  const Assembly in = make_assembly(c);
  EXPECT_EQ(in.fill_joints.at(0).kn, 7e8);
  EXPECT_EQ(in.fill_joints.at(0).ks, stored.fill_joints.at(0).ks);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir

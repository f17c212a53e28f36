// Blocks of COMPAS (JSON) and glTF: what the formats allow, and files that are not what they say.
#include <gtest/gtest.h>

#include <cstring>

#include "io/vtk/import.h"
#include "io/vtk/surface_file.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using nlohmann::json;
using test::Folder;

/// A box as a mesh of COMPAS; `text_keys`: faces name vertices by texts, as COMPAS 0 does.
json mesh_of(const Vec3& low, const Vec3& high, bool text_keys = false) {
  const Polyhedron box = make_box(low, high);
  json vertex = json::object(), face = json::object();
  for (std::size_t v = 0; v < box.vertices.size(); ++v)
    vertex[std::to_string(v + 8)] = {
        {"x", box.vertices[v].x()}, {"y", box.vertices[v].y()}, {"z", box.vertices[v].z()}};
  for (std::size_t f = 0; f < box.faces.size(); ++f) {
    json loop = json::array();
    for (const int v : box.faces[f])
      if (text_keys)
        loop.push_back(std::to_string(v + 8));
      else
        loop.push_back(v + 8);
    face[std::to_string(f)] = loop;
  }
  return {{"vertex", vertex}, {"face", face}, {"default_vertex_attributes", {{"x", 0.0}, {"y", 0.0}, {"z", 0.0}}}};
}

json typed(const std::string& type, const json& data) {
  return {{"dtype", type}, {"data", data}, {"guid", "0"}};
}

json block(const json& mesh, const std::string& name = "") {
  json out = typed("compas_assembly.datastructures/Block", mesh);
  if (!name.empty()) out["name"] = name;
  return out;
}

/// A pile of `count` cubes; the key 10 comes after 9.
json assembly(int count) {
  json node = json::object();
  for (int k = 0; k < count; ++k)
    node[std::to_string(k)] = {
        {"block", block(mesh_of({0, 0, double(k)}, {1, 1, k + 1.0}), k == 3 ? "third" : "Block")},
        {"is_support", k == 0}};
  const json graph = typed("compas.datastructures/Graph", {{"node", node}, {"edge", json::object()}});
  return typed("compas_assembly.datastructures/Assembly", {{"attributes", {{"name", "A"}}}, {"graph", graph}});
}

Import import_json(const json& file, const std::string& name = "model.json") {
  const Folder folder;
  ImportOptions options;
  options.keep_fixed = true;
  return import_blocks(folder.write(name, file.dump()), options);
}

TEST(BlockModels, AnAssemblyOfCompas) {
  const Import import = import_json(assembly(12));
  ASSERT_EQ(import.assembly.blocks.size(), 12u);
  EXPECT_EQ(import.assembly.joints.size(), 11u);
  EXPECT_EQ(import.names[3], "third");
  EXPECT_EQ(import.names[10], "block 10");
  EXPECT_NEAR(import.assembly.blocks[10].centroid.z(), 10.5, 1e-12);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(import.assembly.blocks[i].fixed, i == 0);
  EXPECT_NE(import.notes.at(0).find("1 stone is a support in this file"), std::string::npos);
}

/// compas_dem: elements by GUIDs in the order of the graph, moved by their transformations; other shapes than meshes.
TEST(BlockModels, AModelOfCompas) {
  const auto element = [](const json& geometry, bool support, const json& matrix = nullptr) {
    json data = {{"geometry", geometry}, {"is_support", support}, {"name", "Block"}, {"transformation", nullptr}};
    if (!matrix.is_null()) data["transformation"] = typed("compas.geometry/Transformation", {{"matrix", matrix}});
    return typed("compas_dem.elements/Block", data);
  };
  const json up = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 1}, {0, 0, 0, 1}};
  const json frame =
      typed("compas.geometry/Frame", {{"point", {0.5, 0.5, 2.5}}, {"xaxis", {0, 1, 0}}, {"yaxis", {-1, 0, 0}}});
  const Polyhedron last = make_box({0, 0, 3}, {1, 1, 4});
  json vertices = json::array();
  for (const Vec3& p : last.vertices) vertices.push_back({p.x(), p.y(), p.z()});
  const json elements = {
      {"d", element(typed("compas.datastructures/Mesh", mesh_of({0, 0, 0}, {1, 1, 1})), true)},
      {"c", element(typed("compas.datastructures/Mesh", mesh_of({0, 0, 0}, {1, 1, 1})), false, up)},
      {"b",
       element(typed("compas.geometry/Box", {{"xsize", 1}, {"ysize", 1}, {"zsize", 1.0}, {"frame", frame}}), false)},
      {"a", element(typed("compas.geometry/Polyhedron", {{"vertices", vertices}, {"faces", last.faces}}), false)}};
  const json nodes = {
      {"0", {{"element", "d"}}}, {"1", {{"element", "c"}}}, {"2", {{"element", "b"}}}, {"3", {{"element", "a"}}}};
  const json model = typed("compas_dem.models/BlockModel",
                           {{"elements", elements}, {"transformation", nullptr}, {"graph", {{"node", nodes}}}});
  const Import import = import_json(model);
  ASSERT_EQ(import.assembly.blocks.size(), 4u);
  EXPECT_EQ(import.assembly.joints.size(), 3u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(import.assembly.blocks[i].centroid.z(), i + 0.5, 1e-12);
    EXPECT_EQ(import.assembly.blocks[i].fixed, i == 0);
    EXPECT_NEAR(import.assembly.blocks[i].mass, 2000.0, 1e-9);
  }
}

TEST(BlockModels, OlderAndSimplerFormsOfCompas) {
  const json old = {
      {"assembly", {{"dva", {{"is_support", false}}}, {"vertex", {{"0", {{"is_support", true}}}, {"1", {{"x", 0}}}}}}},
      {"blocks", {{"0", mesh_of({0, 0, 0}, {1, 1, 1}, true)}, {"1", mesh_of({0, 0, 1}, {1, 1, 2}, true)}}}};
  const Import import = import_json(old);
  EXPECT_EQ(import.assembly.joints.size(), 1u);
  EXPECT_TRUE(import.assembly.blocks[0].fixed);
  EXPECT_FALSE(import.assembly.blocks[1].fixed);
  EXPECT_EQ(import_json(typed("compas.datastructures/Mesh", mesh_of({0, 0, 0}, {1, 1, 1}))).assembly.blocks.size(), 1u);
  EXPECT_EQ(import_json(json::array({typed("compas.datastructures/Mesh", mesh_of({0, 0, 0}, {1, 1, 1})),
                                     typed("compas.datastructures/Mesh", mesh_of({0, 0, 1}, {1, 1, 2}))}))
                .assembly.joints.size(),
            1u);
}

void expect_refused(const std::string& bytes, const std::string& name, const std::string& piece) {
  const Folder folder;
  const std::string said = test::message_of<InputError>([&] { import_blocks(folder.write(name, bytes)); });
  EXPECT_NE(said.find(piece), std::string::npos) << said;
  EXPECT_NE(said.find(name), std::string::npos) << said;
  EXPECT_LT(said.size(), 600u);
}

TEST(BlockModels, DamagedCompasFilesAreNamed) {
  expect_refused("{", "a.json", "not valid JSON");
  expect_refused("[]", "a.json", "has no faces");
  expect_refused("3", "a.json", "block 0");
  expect_refused("{\"dtype\": \"compas.geometry/Brep\", \"data\": {}}", "a.json", "compas.geometry/Brep");
  json bad = assembly(2);
  json& node = bad["data"]["graph"]["data"]["node"]["1"]["block"]["data"];
  node["face"]["0"][1] = 99;
  expect_refused(bad.dump(), "a.json", "vertex 99, which does not exist");
  bad = assembly(2);
  bad["data"]["graph"]["data"]["node"]["1"]["block"]["data"]["vertex"]["8"]["x"] = "wide";
  expect_refused(bad.dump(), "a.json", "instead of a finite number");
  bad = assembly(2);
  bad["data"]["graph"]["data"]["node"]["1"]["block"]["data"]["face"] = json::object();
  expect_refused(bad.dump(), "a.json", "has no faces");
  bad = assembly(2);
  bad["data"]["graph"]["data"]["node"]["1"]["block"]["data"]["face"].erase("0");
  expect_refused(bad.dump(), "a.json", "not closed");
}

/// Cubes under nodes, y up: each mesh of triangles with corners of its own.
struct Gltf {
  std::string bytes;
  json file = {{"asset", {{"version", "2.0"}}}, {"scene", 0},
               {"scenes", {{{"nodes", {0}}}}},  {"nodes", json::array()},
               {"meshes", json::array()},       {"accessors", json::array()},
               {"bufferViews", json::array()}};

  template <class Number>
  int add(const std::vector<Number>& values, int type, const std::string& shape, int columns) {
    while (bytes.size() % 4) bytes += '\0';
    file["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(Number)}});
    file["accessors"].push_back({{"bufferView", file["bufferViews"].size() - 1},
                                 {"componentType", type},
                                 {"count", values.size() / std::size_t(columns)},
                                 {"type", shape}});
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number));
    return int(file["accessors"].size()) - 1;
  }

  /// A unit cube; with indices or without.
  void add_cube(bool indexed) {
    const Polyhedron box = make_box({0, 0, 0}, {1, 1, 1});
    std::vector<float> points;
    std::vector<std::uint16_t> corners;
    const auto add_point = [&](int v) {
      for (int k = 0; k < 3; ++k) points.push_back(float(box.vertices[std::size_t(v)][k]));
    };
    if (indexed)
      for (int v = 0; v < 8; ++v) add_point(v);
    for (const auto& loop : box.faces)
      for (std::size_t k = 1; k + 1 < loop.size(); ++k)
        for (const int v : {loop[0], loop[k], loop[k + 1]}) {
          corners.push_back(std::uint16_t(v));
          if (!indexed) add_point(v);
        }
    json primitive = {{"attributes", {{"POSITION", add(points, 5126, "VEC3", 3)}}}};
    if (indexed) primitive["indices"] = add(corners, 5123, "SCALAR", 1);
    file["meshes"].push_back({{"primitives", json::array({primitive})}});
  }

  std::string embedded() const {
    static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      std::uint32_t three = 0;
      for (std::size_t k = 0; k < 3; ++k)
        three = three << 8 | (i + k < bytes.size() ? (unsigned char)(bytes[i + k]) : 0u);
      for (int k = 3; k >= 0; --k) text += i + std::size_t(3 - k) <= bytes.size() ? digits[three >> (6 * k) & 63] : '=';
    }
    json whole = file;
    whole["buffers"] = {{{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + text}}};
    return whole.dump();
  }
  std::string beside(const std::string& name) const {
    json whole = file;
    whole["buffers"] = {{{"byteLength", bytes.size()}, {"uri", name}}};
    return whole.dump();
  }
  std::string binary() const {
    json whole = file;
    whole["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string text = whole.dump(), tail = bytes;
    while (text.size() % 4) text += ' ';
    while (tail.size() % 4) tail += '\0';
    const auto word = [](std::size_t value) {
      const std::uint32_t number = std::uint32_t(value);
      return std::string(reinterpret_cast<const char*>(&number), 4);
    };
    return "glTF" + word(2) + word(28 + text.size() + tail.size()) + word(text.size()) + "JSON" + text +
           word(tail.size()) + std::string("BIN\0", 4) + tail;
  }
};

/// The lower cube stands for itself, the upper one is turned about y and mirrored; both hang under a named node.
Gltf two_cubes() {
  Gltf out;
  out.add_cube(true);
  out.add_cube(false);
  out.file["nodes"] = {{{"name", "vault"}, {"children", {1, 2}}, {"translation", {0, 1, 0}}},
                       {{"name", "low"}, {"mesh", 0}},
                       {{"name", "high"},
                        {"mesh", 1},
                        {"translation", {0, 1, 0}},
                        {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}},
                        {"scale", {-1, 1, 1}}}};
  return out;
}

TEST(BlockModels, GltfEmbeddedBesideAndBinary) {
  const Gltf gltf = two_cubes();
  const Folder folder;
  folder.write("a buffer.bin", gltf.bytes);
  ImportOptions options;
  const Material usual = options.material;
  options.map = read_name_map(folder.write("names.toml", "[layers]\nvault = {component = \"arch\"}\n"), usual);
  for (const std::string& file :
       {folder.write("a.gltf", gltf.embedded()), folder.write("b.gltf", gltf.beside("a%20buffer.bin")),
        folder.write("c.glb", gltf.binary())}) {
    const Import import = import_blocks(file, options);
    ASSERT_EQ(import.assembly.blocks.size(), 2u) << file;
    EXPECT_EQ(import.names, (std::vector<std::string>{"low", "high"}));
    EXPECT_EQ(import.assembly.joints.size(), 1u);
    EXPECT_NEAR(import.assembly.blocks[0].centroid.z(), 1.5, 1e-6);
    EXPECT_NEAR(import.assembly.blocks[1].centroid.z(), 2.5, 1e-6);  // y up is z up
    EXPECT_EQ(import.assembly.blocks[1].component, Component::arch);
    EXPECT_TRUE(import.notes.empty()) << import.notes[0];  // mirrored, but not inside-out
  }
  options.up = "z";
  EXPECT_NEAR(import_blocks(folder / "a.gltf", options).assembly.blocks[1].centroid.y(), 2.5, 1e-6);
}

TEST(BlockModels, DamagedGltfFilesAreNamed) {
  const Gltf gltf = two_cubes();
  const std::string whole = gltf.binary();
  for (const std::size_t size : {4u, 11u, 30u, 200u, unsigned(whole.size() - 30)})
    EXPECT_NE(test::message_of<InputError>([&] { parse_gltf(whole.substr(0, size), "a.glb"); }), "") << size;
  const auto refused = [&](const char* pointer, const json& value, const std::string& piece) {
    Gltf other = two_cubes();
    other.file[json::json_pointer(pointer)] = value;
    expect_refused(other.embedded(), "a.gltf", piece);
  };
  refused("/asset/version", "1.0", "version '1.0'");
  refused("/extensionsRequired", {"KHR_draco_mesh_compression"}, "without compression");
  refused("/nodes/1/children", {0}, "has two parents");
  refused("/nodes/1/mesh", 7, "a mesh is 7, but there are 2");
  refused("/accessors/0/count", 1000000000, "do not fit");
  refused("/accessors/0/type", "VEC2", "It must be VEC3");
  refused("/accessors/0/componentType", 7, "does not know");
  refused("/bufferViews/0/byteOffset", 1 << 30, "do not fit");
  refused("/nodes/2/rotation", {0, 0, 0, 0}, "not a unit quaternion");
  refused("/nodes/2/scale", {1, 1}, "needs 3 numbers");
  refused("/meshes/0/primitives/0/mode", 9, "mode 9");
  expect_refused(gltf.beside("none.bin"), "a.gltf", "none.bin");
  expect_refused(gltf.beside("https://x.org/a.bin"), "a.gltf", "in the same folder");
  expect_refused("{}", "a.gltf", "version");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir

// Block models of COMPAS (compas.dev), as JSON. Every object is {"dtype": …, "data": …}; the contents of `data`
// have changed over the years. The program reads
//   Assembly of COMPAS 1 and 2 (compas_assembly, compas_cra): graph / node / N / block, is_support beside the block;
//   Model of COMPAS 2 (compas_model, compas_dem): elements / GUID / geometry, is_support beside the geometry;
//   Assembly of COMPAS 0 (compas_rbe): assembly / vertex / N and blocks / N;
//   one Mesh, Polyhedron or Box, or a list of them.
// A mesh has vertex / N / {x, y, z} and face / N / [N, …].
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "io/vtk/surface_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "solver/base/shown.h"

namespace voussoir {
namespace {

using Json = nlohmann::json;

/// Rotation and translation, or any other affine map.
using Affine = Eigen::Matrix<double, 3, 4>;
Affine no_change() {
  Affine out = Affine::Zero();
  out.leftCols<3>().setIdentity();
  return out;
}
Affine after(const Affine& second, const Affine& first) {
  Affine out;
  out.leftCols<3>() = second.leftCols<3>() * first.leftCols<3>();
  out.col(3) = second.leftCols<3>() * first.col(3) + second.col(3);
  return out;
}

/// The data of a "dtype"/"data" pair, or the value itself.
const Json& inner(const Json& json) {
  const bool wrapped =
      json.is_object() && json.contains("data") && (json.contains("dtype") || json.contains("datatype"));
  return wrapped ? json["data"] : json;
}

const Json* member(const Json& json, const char* key) {
  if (!json.is_object()) return nullptr;
  const auto found = json.find(key);
  return found == json.end() || found->is_null() ? nullptr : &*found;
}

/// Keys of an object, numbers in their order: JSON has none, and "10" would stand before "2".
std::vector<std::string> keys_of(const Json& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  const auto number = [](const std::string& key) {
    long value = -1;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), value);
    return error == std::errc{} && end == key.data() + key.size() ? value : -1;
  };
  std::stable_sort(keys.begin(), keys.end(), [&](const std::string& a, const std::string& b) {
    return std::pair(number(a) < 0, number(a)) < std::pair(number(b) < 0, number(b));
  });
  return keys;
}

class CompasReader {
 public:
  explicit CompasReader(const std::string& path) : path_(path) {}

  Surface read(const Json& file) {
    const Json& data = inner(file);
    const Json* graph = member(data, "graph");
    const Json* nodes = graph ? member(inner(*graph), "node") : nullptr;
    if (const Json* elements = member(data, "elements"))
      read_model(data, *elements, nodes);
    else if (nodes && nodes->is_object())
      read_assembly(*nodes, member(inner(*graph), "default_node_attributes"));
    else if (member(data, "assembly") && member(data, "blocks"))
      read_old(inner(data["assembly"]), inner(data["blocks"]));
    else if (data.is_array())
      for (std::size_t i = 0; i < data.size(); ++i) add_shape(data[i], fmt::format("{}", i), "", false, no_change());
    else
      add_shape(file, "0", "", false, no_change());
    return std::move(surface_);
  }

 private:
  [[noreturn]] void fail(const std::string& where, const std::string& what) const {
    throw InputError("{}: {}: {}", path_, shown(where), what);
  }

  void read_assembly(const Json& nodes, const Json* usual) {
    const bool support = usual && is_support(*usual);
    for (const std::string& key : keys_of(nodes)) {
      const Json& node = nodes[key];
      const Json* block = member(node, "block");
      if (!block) block = member(node, "element");
      if (!block) {
        surface_.notes.push_back(fmt::format("{}: node {} has no block", path_, shown(key)));
        continue;
      }
      add_shape(*block, key, name_of(node), member(node, "is_support") ? is_support(node) : support, no_change());
    }
  }

  /// Elements by their GUIDs, which say nothing of an order: that of the graph's nodes is the order of the model.
  void read_model(const Json& model, const Json& elements, const Json* nodes) {
    const Affine whole = transformation(model, "the model");
    if (const Json* materials = member(model, "materials"); materials && !materials->empty())
      surface_.notes.push_back(fmt::format("{}: its {} ignored; set materials with options or --map", path_,
                                           counted(materials->size(), "material was", "materials were")));
    std::vector<std::pair<std::string, const Json*>> list;
    if (elements.is_array())
      for (std::size_t i = 0; i < elements.size(); ++i) list.push_back({fmt::format("{}", i), &elements[i]});
    if (elements.is_object()) {
      std::vector<std::string> order;
      if (nodes && nodes->is_object())
        for (const std::string& key : keys_of(*nodes))
          if (const Json* guid = member((*nodes)[key], "element"); guid && guid->is_string())
            order.push_back(guid->get<std::string>());
      for (const std::string& guid : keys_of(elements))
        if (std::find(order.begin(), order.end(), guid) == order.end()) order.push_back(guid);
      for (std::size_t i = 0; i < order.size(); ++i)
        if (const Json* element = member(elements, order[i].c_str())) list.push_back({fmt::format("{}", i), element});
    }
    for (const auto& [key, json] : list) {
      const Json& element = inner(*json);
      const Json* geometry = member(element, "geometry");
      if (!geometry) geometry = member(element, "_geometry");
      if (!geometry) fail("element " + key, "it has no geometry");
      const Affine place = after(whole, transformation(element, "element " + key));
      add_shape(*geometry, key, name_of(element), is_support(element), place);
    }
  }

  void read_old(const Json& assembly, const Json& blocks) {
    const Json* attributes = member(assembly, "vertex");
    const Json* usual = member(assembly, "dva");
    if (!blocks.is_object()) fail("blocks", "they must be an object of meshes");
    for (const std::string& key : keys_of(blocks)) {
      const Json* own = attributes ? member(*attributes, key.c_str()) : nullptr;
      const bool support = own && member(*own, "is_support") ? is_support(*own) : usual && is_support(*usual);
      add_shape(blocks[key], key, "", support, no_change());
    }
  }

  static bool is_support(const Json& node) {
    const Json* found = member(node, "is_support");
    return found && found->is_boolean() && found->get<bool>();
  }

  /// Names that say no more than the kind of thing are those that COMPAS gives itself.
  static std::string name_of(const Json& json) {
    const Json* name = member(json, "name");
    if (!name || !name->is_string()) return "";
    const std::string text = name->get<std::string>();
    for (const char* usual : {"Block", "Mesh", "Box", "Polyhedron", "Element"})
      if (text == usual) return "";
    return text;
  }

  Affine transformation(const Json& json, const std::string& where) const {
    const Json* found = member(json, "transformation");
    if (!found) found = member(json, "frame_transformation");
    if (!found) return no_change();
    const Json* matrix = member(inner(*found), "matrix");
    if (!matrix || !matrix->is_array() || matrix->size() != 4)
      fail(where, "its transformation must be a matrix of 4 rows");
    Affine out;
    for (int row = 0; row < 3; ++row) {
      const Json& values = (*matrix)[std::size_t(row)];
      if (!values.is_array() || values.size() != 4) fail(where, "its transformation must be a matrix of 4 columns");
      for (int column = 0; column < 4; ++column) out(row, column) = number(values[std::size_t(column)], where);
    }
    return out;
  }

  double number(const Json& json, const std::string& where) const {
    if (!json.is_number() || !std::isfinite(json.get<double>()))
      fail(where, fmt::format("it has {} instead of a finite number", json_excerpt(json)));
    return json.get<double>();
  }

  Vec3 vector(const Json& json, const std::string& where) const {
    const Json& values = inner(json);
    if (!values.is_array() || values.size() != 3) fail(where, "it needs three numbers");
    return {number(values[0], where), number(values[1], where), number(values[2], where)};
  }

  /// The name of an object: its own name, else that of its parent, else its key.
  void add_shape(const Json& json, const std::string& key, std::string name, bool support, const Affine& place) {
    const Json& data = inner(json);
    if (name.empty()) name = name_of(json);
    if (name.empty()) name = name_of(data);
    if (const Json* attributes = member(data, "attributes"); name.empty() && attributes) name = name_of(*attributes);
    surface_.objects.push_back({name.empty() ? "block " + key : name, 0, {}});
    surface_.objects.back().support = support;
    const std::string where = "block " + key;
    const Json* geometry = member(data, "geometry");
    add_geometry(geometry ? *geometry : json, where, place);
    if (surface_.objects.back().faces.empty()) fail(where, "its shape has no faces");
  }

  void add_geometry(const Json& json, const std::string& where, const Affine& place) {
    const Json& data = inner(json);
    if (member(data, "vertex") && member(data, "face")) return add_mesh(data, where, place);
    if (member(data, "vertices") && member(data, "faces")) return add_polyhedron(data, where, place);
    if (member(data, "xsize")) return add_box(data, where, place);
    const Json* type = member(json, "dtype");
    fail(where, fmt::format("its shape is {}. It must be a Mesh, a Polyhedron or a Box of COMPAS",
                            type ? json_excerpt(*type) : "of a kind that is not known"));
  }

  int add_vertex(const Vec3& p, const Affine& place) {
    surface_.vertices.push_back(place.leftCols<3>() * p + place.col(3));
    return int(surface_.vertices.size()) - 1;
  }

  void add_face(std::vector<int> loop, const std::string& where) {
    if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() < 3) fail(where, fmt::format("a face has {}; it needs at least 3", counted(loop.size(), "corner")));
    surface_.objects.back().faces.push_back(int(surface_.faces.size()));
    surface_.faces.push_back(std::move(loop));
    surface_.face_lines.push_back(0);
  }

  void add_mesh(const Json& mesh, const std::string& where, const Affine& place) {
    const Json &vertices = mesh["vertex"], &faces = mesh["face"];
    if (!vertices.is_object() || !faces.is_object()) fail(where, "'vertex' and 'face' of a mesh must be objects");
    const Json* usual = member(mesh, "default_vertex_attributes");
    std::map<std::string, int> known;
    for (const std::string& key : keys_of(vertices)) {
      Vec3 point = Vec3::Zero();
      for (int k = 0; k < 3; ++k) {
        const std::string axis(1, "xyz"[k]);
        const Json* value = member(vertices[key], axis.c_str());
        if (!value && usual) value = member(*usual, axis.c_str());
        if (!value) fail(where, fmt::format("vertex {} has no {}", shown(key), axis));
        point[k] = number(*value, where);
      }
      known[key] = add_vertex(point, place);
    }
    for (const std::string& key : keys_of(faces)) {
      std::vector<int> loop;
      if (!faces[key].is_array()) fail(where, fmt::format("face {} must be a list of vertices", shown(key)));
      for (const Json& corner : faces[key]) {
        const std::string text = corner.is_string() ? corner.get<std::string>() : corner.dump();
        const auto found = known.find(text);
        if (found == known.end())
          fail(where, fmt::format("face {} has the vertex {}, which does not exist", shown(key), shown(text)));
        loop.push_back(found->second);
      }
      add_face(std::move(loop), where);
    }
  }

  void add_polyhedron(const Json& shape, const std::string& where, const Affine& place) {
    const Json &vertices = shape["vertices"], &faces = shape["faces"];
    if (!vertices.is_array() || !faces.is_array()) fail(where, "'vertices' and 'faces' must be lists");
    const int first = int(surface_.vertices.size());
    for (const Json& point : vertices) add_vertex(vector(point, where), place);
    for (const Json& face : faces) {
      std::vector<int> loop;
      if (!face.is_array()) fail(where, "a face must be a list of vertices");
      for (const Json& corner : face) {
        if (!corner.is_number_integer() || corner.get<std::int64_t>() < 0 ||
            corner.get<std::int64_t>() >= std::int64_t(vertices.size()))
          fail(where, fmt::format("a face has the vertex {}, but there are {} vertices", json_excerpt(corner),
                                  vertices.size()));
        loop.push_back(first + int(corner.get<std::int64_t>()));
      }
      add_face(std::move(loop), where);
    }
  }

  void add_box(const Json& box, const std::string& where, const Affine& place) {
    Vec3 half;
    for (int k = 0; k < 3; ++k) {
      const char* const keys[] = {"xsize", "ysize", "zsize"};
      const Json* size = member(box, keys[k]);
      if (!size) fail(where, fmt::format("the box has no {}", keys[k]));
      half[k] = 0.5 * number(*size, where);
    }
    Affine frame = no_change();
    if (const Json* own = member(box, "frame")) {
      const Json& f = inner(*own);
      if (!member(f, "point") || !member(f, "xaxis") || !member(f, "yaxis"))
        fail(where, "the frame of a box needs point, xaxis and yaxis");
      const Vec3 x = vector(f["xaxis"], where).normalized();
      const Vec3 z = x.cross(vector(f["yaxis"], where)).normalized();
      if (!x.allFinite() || !z.allFinite())
        fail(where, "the axes of the frame of the box are zero and have no direction");
      frame.col(0) = x, frame.col(1) = z.cross(x), frame.col(2) = z, frame.col(3) = vector(f["point"], where);
    }
    const Polyhedron shape = make_box(-half, half);
    const int first = int(surface_.vertices.size());
    for (const Vec3& p : shape.vertices) add_vertex(p, after(place, frame));
    for (std::vector<int> loop : shape.faces) {
      for (int& v : loop) v += first;
      add_face(std::move(loop), where);
    }
  }

  std::string path_;
  Surface surface_;
};

}  // namespace

Surface parse_compas(const std::string& text, const std::string& path) {
  return CompasReader(path).read(parse_json(text, path));
}

}  // namespace voussoir

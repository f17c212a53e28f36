// glTF 2.0 (Khronos Group 2021; ISO/IEC 12113:2022): triangles of meshes, placed by nodes. One stone a closed surface.
#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>

#include "io/vtk/surface_file.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "solver/base/shown.h"

namespace voussoir {
namespace {

using GltfJson = nlohmann::json;
using Placement = Eigen::Matrix4d;

constexpr std::size_t most_corners = 10000000, most_faces = 20000000;  // meshes may stand at many nodes

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  static_assert(std::endian::native == std::endian::little);
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// RFC 4648; nothing where there is another character.
std::optional<std::string> from_base64(std::string_view text) {
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  for (const char c : text) {
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (value < 0) return std::nullopt;
    bits = bits << 6 | std::uint32_t(value);
    if ((count += 6) >= 8) out += char(bits >> (count -= 8) & 0xff);
  }
  return out;
}

/// "%20" of an address is a blank.
std::string without_percents(const std::string& address) {
  std::string out;
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1;
  };
  for (std::size_t i = 0; i < address.size(); ++i) {
    const bool coded =
        address[i] == '%' && i + 2 < address.size() && digit(address[i + 1]) >= 0 && digit(address[i + 2]) >= 0;
    if (!coded) {
      out += address[i];
      continue;
    }
    out += char(16 * digit(address[i + 1]) + digit(address[i + 2]));
    i += 2;
  }
  return out;
}

class GltfReader {
 public:
  GltfReader(const std::string& bytes, const std::string& path) : path_(path) {
    if (bytes.starts_with("glTF"))
      read_binary(bytes);
    else
      json_ = parse_json(bytes, path);
  }

  Surface read() {
    check_version();
    read_buffers();
    const GltfJson& nodes = list("nodes");
    std::vector<std::size_t> roots;
    const std::size_t scene = json_.contains("scene") ? index(json_["scene"], list("scenes").size(), "scene") : 0;
    if (!list("scenes").empty()) {
      const GltfJson& chosen = list("scenes")[scene];
      if (list("scenes").size() > 1)
        surface_.notes.push_back(
            fmt::format("{}: the file has {} scenes; the program has read scene {}, counted from 0", path_,
                        list("scenes").size(), scene));
      for (const GltfJson& root : list("nodes", chosen))
        roots.push_back(index(root, nodes.size(), "a root of the scene"));
    } else {
      for (std::size_t i = 0; i < nodes.size(); ++i) roots.push_back(i);
      for (const GltfJson& node : nodes)
        for (const GltfJson& child : list("children", node)) std::erase(roots, index(child, nodes.size(), "a child"));
    }
    seen_.assign(nodes.size(), false);
    for (const std::size_t root : roots) walk(root);
    if (passed_over_ > 0)
      surface_.notes.push_back(fmt::format(
          "{}: {} ignored", path_,
          counted(passed_over_, "primitive of points or lines was", "primitives of points and lines were")));
    surface_.up = "y";
    return std::move(surface_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError("{}: {}", path_, what); }

  const GltfJson& list(const char* key, const GltfJson& of) const {
    static const GltfJson none = GltfJson::array();
    if (!of.is_object() || !of.contains(key)) return none;
    if (!of[key].is_array()) fail(fmt::format("'{}' must be a list", key));
    return of[key];
  }
  const GltfJson& list(const char* key) const { return list(key, json_); }

  std::size_t index(const GltfJson& json, std::size_t count, const std::string& what) const {
    if (!json.is_number_integer() || json.get<std::int64_t>() < 0 || std::size_t(json.get<std::int64_t>()) >= count)
      fail(fmt::format("{} is {}, but there are {}, which count from 0", what, json_excerpt(json), count));
    return std::size_t(json.get<std::int64_t>());
  }

  std::size_t size(const GltfJson& of, const char* key, std::int64_t fallback) const {
    if (!of.is_object() || !of.contains(key)) {
      if (fallback < 0) fail(fmt::format("'{}' is missing in {}", key, json_excerpt(of)));
      return std::size_t(fallback);
    }
    const GltfJson& value = of[key];
    if (!value.is_number_integer() || value.get<std::int64_t>() < 0 ||
        value.get<std::int64_t>() > (std::int64_t(1) << 40))
      fail(fmt::format("'{}' is {}. It must be a whole number of 0 or more.", key, json_excerpt(value)));
    return std::size_t(value.get<std::int64_t>());
  }

  /// Twelve bytes of head; chunks of length, kind and contents: the JSON first, then the bytes.
  void read_binary(const std::string& bytes) {
    std::size_t at = 12;
    bool has_json = false;
    while (at + 8 <= bytes.size()) {
      const std::size_t length = word_at(bytes, at);
      const std::uint32_t kind = word_at(bytes, at + 4);
      if (length > bytes.size() - at - 8) fail("is cut off: export it again");
      const std::string contents = bytes.substr(at + 8, length);
      if (kind == 0x4e4f534a && !has_json) {
        json_ = parse_json(contents, path_);
        has_json = true;
      }
      if (kind == 0x004e4942 && !own_bytes_) own_bytes_ = contents;
      at += 8 + length;
    }
    if (!has_json) fail("is cut off and has no JSON; export it again");
  }

  void check_version() const {
    if (!json_.is_object()) fail("is not glTF: its JSON is not an object");
    const bool stated = json_.contains("asset") && json_["asset"].is_object() && json_["asset"].contains("version");
    const std::string version =
        stated && json_["asset"]["version"].is_string() ? json_["asset"]["version"].get<std::string>() : "";
    if (!version.starts_with("2."))
      fail(fmt::format("has the glTF version '{}'. It must be 2.0. Export it again.", shown(version)));
    for (const GltfJson& extension : list("extensionsRequired")) {
      const std::string name = extension.is_string() ? extension.get<std::string>() : "";
      if (name != "KHR_mesh_quantization" && !name.starts_with("KHR_materials") && name != "KHR_texture_transform")
        fail(fmt::format("needs the extension {}, which the program does not read: export it without compression",
                         shown(name)));
    }
  }

  void read_buffers() {
    for (const GltfJson& buffer : list("buffers")) {
      const std::string address = buffer.is_object() && buffer.contains("uri") && buffer["uri"].is_string()
                                      ? buffer["uri"].get<std::string>()
                                      : "";
      if (address.empty()) {
        if (!own_bytes_ || !buffers_.empty()) fail("a buffer has no address, and the file has no bytes for it");
        buffers_.push_back(*own_bytes_);
      } else if (address.starts_with("data:")) {
        const std::size_t comma = address.find(";base64,");
        const auto bytes =
            comma == std::string::npos ? std::nullopt : from_base64(std::string_view(address).substr(comma + 8));
        if (!bytes) fail("a buffer within the file is not coded in base64");
        buffers_.push_back(*bytes);
      } else {
        const std::filesystem::path side(without_percents(address));
        if (side.is_absolute() || address.find("://") != std::string::npos)
          fail(fmt::format("its buffer '{}' must be a file in the same folder", shown(address)));
        try {
          buffers_.push_back(read_text((std::filesystem::path(path_).parent_path() / side).string()));
        } catch (const InputError& error) {
          fail(fmt::format("its buffer '{}': {}", shown(address), error.what()));
        }
      }
      if (buffers_.back().size() < size(buffer, "byteLength", 0))
        fail("a buffer is shorter than its length states: export it again");
    }
  }

  /// All numbers of an accessor, `columns` a row.
  std::vector<double> numbers(std::size_t number, std::size_t columns) const {
    const GltfJson& accessor = list("accessors")[number];
    if (accessor.is_object() && accessor.contains("sparse"))
      fail("the program does not read sparse accessors: export it without them");
    const std::size_t count = size(accessor, "count", -1), type = size(accessor, "componentType", -1);
    const std::string shape =
        accessor.contains("type") && accessor["type"].is_string() ? accessor["type"].get<std::string>() : "";
    if (shape != (columns == 3 ? "VEC3" : "SCALAR"))
      fail(fmt::format("accessor {} is {}. It must be {}.", number, shown(shape), columns == 3 ? "VEC3" : "SCALAR"));
    static const std::map<std::size_t, std::size_t> widths = {{5120, 1}, {5121, 1}, {5122, 2},
                                                              {5123, 2}, {5125, 4}, {5126, 4}};
    if (!widths.contains(type))
      fail(fmt::format("accessor {} has numbers of kind {}, which glTF does not know", number, type));
    const std::size_t width = widths.at(type);
    const bool scaled = accessor.contains("normalized") && accessor["normalized"] == true;
    if (!accessor.contains("bufferView")) fail(fmt::format("accessor {} has no bufferView", number));
    const GltfJson& view =
        list("bufferViews")[index(accessor["bufferView"], list("bufferViews").size(), "a bufferView")];
    if (!view.is_object() || !view.contains("buffer")) fail("a bufferView has no buffer");
    const std::string& bytes = buffers_[index(view["buffer"], buffers_.size(), "a buffer")];
    const std::size_t stride = std::max(size(view, "byteStride", 0), width * columns);
    const std::size_t begin = size(view, "byteOffset", 0) + size(accessor, "byteOffset", 0);
    const std::size_t room = begin < bytes.size() ? bytes.size() - begin : 0;
    if (count == 0 || room < width * columns || (count - 1) > (room - width * columns) / stride)
      fail(fmt::format("accessor {}: {} rows from byte {} on do not fit into the {} bytes of its buffer", number, count,
                       begin, bytes.size()));
    std::vector<double> out;
    out.reserve(count * columns);
    for (std::size_t row = 0; row < count; ++row)
      for (std::size_t k = 0; k < columns; ++k)
        out.push_back(value(bytes.data() + begin + row * stride + k * width, type, scaled));
    return out;
  }

  template <class Number>
  static double as(const char* raw, bool scaled) {
    Number value;
    std::memcpy(&value, raw, sizeof value);
    return scaled ? std::max(double(value) / double(std::numeric_limits<Number>::max()), -1.0) : double(value);
  }
  static double value(const char* raw, std::size_t type, bool scaled) {
    if (type == 5120) return as<std::int8_t>(raw, scaled);
    if (type == 5121) return as<std::uint8_t>(raw, scaled);
    if (type == 5122) return as<std::int16_t>(raw, scaled);
    if (type == 5123) return as<std::uint16_t>(raw, scaled);
    if (type == 5125) return as<std::uint32_t>(raw, scaled);
    float number;
    std::memcpy(&number, raw, sizeof number);
    return number;
  }

  /// Nodes form a forest. The program uses a list instead of recursion, because the depth may be as large as the file.
  void walk(std::size_t root) {
    struct Todo {
      std::size_t node;
      Placement above;
      std::string layer;
    };
    const GltfJson& nodes = list("nodes");
    for (std::vector<Todo> todo = {{root, Placement::Identity(), ""}}; !todo.empty();) {
      const Todo next = todo.back();
      todo.pop_back();
      const GltfJson& node = nodes[next.node];
      if (!node.is_object()) fail(fmt::format("node {} is not an object", next.node));
      if (seen_[next.node]) fail(fmt::format("node {} has two parents, or is its own ancestor", next.node));
      seen_[next.node] = true;
      const Placement place = next.above * placement(node, next.node);
      const std::string name = name_of(node);
      if (node.contains("mesh")) {
        const GltfJson& mesh = list("meshes")[index(node["mesh"], list("meshes").size(), "a mesh")];
        add_mesh(mesh, name.empty() ? name_of(mesh) : name, next.layer, place);
      }
      const GltfJson& children = list("children", node);
      for (auto child = children.rbegin(); child != children.rend(); ++child)
        todo.push_back({index(*child, nodes.size(), "a child"), place, name.empty() ? next.layer : name});
    }
  }

  static std::string name_of(const GltfJson& json) {
    return json.is_object() && json.contains("name") && json["name"].is_string() ? json["name"].get<std::string>() : "";
  }

  std::vector<double> values(const GltfJson& node, const char* key, std::size_t count,
                             std::vector<double> usual) const {
    if (!node.contains(key)) return usual;
    std::vector<double> out;
    for (const GltfJson& value : list(key, node)) {
      if (!value.is_number() || !std::isfinite(value.get<double>()))
        fail(fmt::format("'{}' of a node must be finite numbers", key));
      out.push_back(value.get<double>());
    }
    if (out.size() != count) fail(fmt::format("'{}' of a node needs {} numbers, but has {}", key, count, out.size()));
    return out;
  }

  Placement placement(const GltfJson& node, std::size_t number) const {
    Placement out = Placement::Identity();
    if (node.contains("matrix")) {
      const std::vector<double> m = values(node, "matrix", 16, {});
      return Eigen::Map<const Placement>(m.data());  // column by column, as glTF has it
    }
    const auto move = values(node, "translation", 3, {0, 0, 0}), size = values(node, "scale", 3, {1, 1, 1}),
               turn = values(node, "rotation", 4, {0, 0, 0, 1});
    const Eigen::Quaterniond rotation(turn[3], turn[0], turn[1], turn[2]);
    if (!(rotation.norm() > 0.5)) fail(fmt::format("the rotation of node {} is not a unit quaternion", number));
    out.topLeftCorner<3, 3>() = rotation.normalized().toRotationMatrix() * Vec3(size[0], size[1], size[2]).asDiagonal();
    out.topRightCorner<3, 1>() = Vec3(move[0], move[1], move[2]);
    return out;
  }

  void add_mesh(const GltfJson& mesh, const std::string& name, const std::string& layer, const Placement& place) {
    FileObject object{name, 0, {}, layer};
    const bool mirrored = place.topLeftCorner<3, 3>().determinant() < 0.0;
    for (const GltfJson& primitive : list("primitives", mesh)) {
      const std::size_t mode = size(primitive, "mode", 4);
      if (mode < 4) {
        ++passed_over_;
        continue;
      }
      if (mode > 6) fail(fmt::format("a primitive is of mode {}, which glTF does not know", mode));
      add_primitive(primitive, mode, mirrored, place, object);
    }
    if (!object.faces.empty()) surface_.objects.push_back(std::move(object));
  }

  void add_primitive(const GltfJson& primitive, std::size_t mode, bool mirrored, const Placement& place,
                     FileObject& object) {
    const bool placed = primitive.contains("attributes") && primitive["attributes"].is_object() &&
                        primitive["attributes"].contains("POSITION");
    if (!placed) fail("a primitive has no POSITION");
    const std::size_t accessors = list("accessors").size();
    const auto points = numbers(index(primitive["attributes"]["POSITION"], accessors, "POSITION"), 3);
    const int first = int(surface_.vertices.size());
    const int count = int(points.size() / 3);
    if (surface_.vertices.size() + std::size_t(count) > most_corners) fail("has more than ten million corners");
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector4d p = place * Eigen::Vector4d(points[std::size_t(3 * i)], points[std::size_t(3 * i + 1)],
                                                        points[std::size_t(3 * i + 2)], 1.0);
      if (!p.allFinite()) fail(fmt::format("a corner of '{}' is not a finite number", shown(object.name)));
      surface_.vertices.push_back(p.head<3>());
    }
    std::vector<int> corners;
    if (primitive.contains("indices")) {
      for (const double v : numbers(index(primitive["indices"], accessors, "indices"), 1)) {
        if (!(v >= 0.0 && v < count))
          fail(fmt::format("a face of '{}' has the corner {}, but there are {} corners", shown(object.name), v, count));
        corners.push_back(first + int(v));
      }
    } else {
      for (int i = 0; i < count; ++i) corners.push_back(first + i);
    }
    if (surface_.faces.size() + corners.size() > most_faces) fail("has more than twenty million faces");
    const auto add = [&](int a, int b, int c) {
      if (a == b || b == c || c == a) return;  // strips are stitched together with such
      object.faces.push_back(int(surface_.faces.size()));
      surface_.faces.push_back(mirrored ? std::vector{a, c, b} : std::vector{a, b, c});
      surface_.face_lines.push_back(0);
    };
    for (std::size_t i = 0; i + 2 < corners.size(); i += mode == 4 ? 3 : 1) {
      if (mode == 6)
        add(corners[0], corners[i + 1], corners[i + 2]);
      else if (mode == 5 && i % 2 == 1)
        add(corners[i + 1], corners[i], corners[i + 2]);
      else
        add(corners[i], corners[i + 1], corners[i + 2]);
    }
  }

  std::string path_;
  GltfJson json_;
  std::optional<std::string> own_bytes_;
  std::vector<std::string> buffers_;
  std::vector<bool> seen_;
  std::size_t passed_over_ = 0;
  Surface surface_;
};

}  // namespace

Surface parse_gltf(const std::string& bytes, const std::string& path) {
  return GltfReader(bytes, path).read();
}

}  // namespace voussoir

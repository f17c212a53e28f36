// Our own reader: VTK's crashes on damaged files.
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>

#include "io/vtk/surface_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"

namespace voussoir {
namespace {

struct Type {
  std::size_t bytes = 0;
  bool floating = false, is_signed = false;
};

struct Property {
  std::string name;
  Type type;
  bool list = false;
  Type count;  // of a list's length
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(const std::string& bytes, const std::string& path) : path_(path), bytes_(bytes) {}

  Surface read() {
    read_header();
    surface_.objects.push_back({"", 0, {}});
    for (const Element& element : elements_)
      for (std::size_t i = 0; i < element.count; ++i) read_row(element, i);
    if (surface_.faces.empty()) surface_.objects.clear();
    return std::move(surface_);
  }

 private:
  enum class Form { text, little, big };

  [[noreturn]] void fail(const std::string& what) const {
    if (form_ == Form::text) throw InputError("{}:{}: {}", path_, line_, what);
    throw InputError("{}: {}", path_, what);
  }

  std::string header_line() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string::npos) fail("the header of the PLY file is cut off: it has no end_header");
    std::string line = bytes_.substr(at_, end - at_);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    at_ = end + 1;
    ++line_;
    return line;
  }

  void read_header() {
    if (bytes_.find('\n') == std::string::npos || header_line() != "ply")
      fail("is not a PLY file: it must begin with 'ply'");
    Form form = Form::text;
    while (true) {
      std::istringstream words(header_line());
      std::string keyword, word;
      words >> keyword;
      if (keyword == "end_header") break;
      if (keyword == "format") {
        words >> word;
        if (word == "ascii" || word == "binary_little_endian" || word == "binary_big_endian")
          form = word == "ascii" ? Form::text : word == "binary_little_endian" ? Form::little : Form::big;
        else
          fail(fmt::format("the format is '{}'. It must be ascii, binary_little_endian or binary_big_endian",
                           shown(word)));
      } else if (keyword == "element") {
        Element element;
        if (!(words >> element.name >> element.count)) fail("this line must have the form 'element NAME COUNT'");
        elements_.push_back(element);
      } else if (keyword == "property") {
        read_property(words);
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        fail(fmt::format("'{}' is not a keyword of a PLY header", shown(keyword)));
      }
    }
    check_elements();
    form_ = form;
    ++line_;
  }

  void read_property(std::istringstream& words) {
    if (elements_.empty()) fail("there is a property before the first element");
    Property property;
    std::string word;
    words >> word;
    property.list = word == "list";
    if (property.list) {
      words >> word;
      property.count = type_of(word);
      words >> word;
    }
    property.type = type_of(word);
    words >> property.name;
    elements_.back().properties.push_back(property);
  }

  Type type_of(const std::string& name) const {
    const auto any = [&](const char* a, const char* b) { return name == a || name == b; };
    if (any("char", "int8")) return {1, false, true};
    if (any("uchar", "uint8")) return {1, false, false};
    if (any("short", "int16")) return {2, false, true};
    if (any("ushort", "uint16")) return {2, false, false};
    if (any("int", "int32")) return {4, false, true};
    if (any("uint", "uint32")) return {4, false, false};
    if (any("float", "float32")) return {4, true, true};
    if (any("double", "float64")) return {8, true, true};
    fail(fmt::format("'{}' is not a type of a PLY file", shown(name)));
  }

  /// Rows must take room in the file, or a count could keep us busy for ever.
  void check_elements() const {
    for (const Element& element : elements_) {
      if (element.properties.empty() && element.count > 0)
        fail(fmt::format("element {} has no properties", shown(element.name)));
      const auto has = [&](const char* name) {
        return std::any_of(element.properties.begin(), element.properties.end(),
                           [&](const Property& p) { return p.name == name && !p.list; });
      };
      if (element.name == "vertex" && !(has("x") && has("y") && has("z"))) fail("element vertex needs x, y and z");
    }
  }

  void read_row(const Element& element, std::size_t row) {
    const bool vertex = element.name == "vertex", face = element.name == "face";
    Vec3 point = Vec3::Zero();
    for (const Property& p : element.properties) {
      if (p.list) {
        std::vector<double> values = read_list(p, element, row);
        if (face && (p.name == "vertex_indices" || p.name == "vertex_index")) add_face(values, row);
        continue;
      }
      const double value = read_number(p.type, element, row);
      if (vertex && p.name.size() == 1 && p.name[0] >= 'x' && p.name[0] <= 'z') point[p.name[0] - 'x'] = value;
    }
    if (!vertex) return;
    if (!point.allFinite()) fail(fmt::format("vertex {} is not finite", row));
    surface_.vertices.push_back(point);
  }

  std::vector<double> read_list(const Property& p, const Element& element, std::size_t row) {
    const double count = read_number(p.count, element, row);
    if (!(count >= 0.0 && count <= double(bytes_.size() - at_)) || count != std::floor(count))
      fail(fmt::format("{} {}: a list of {} values does not fit into the file", shown(element.name), row, count));
    std::vector<double> values;
    for (std::size_t k = 0; k < std::size_t(count); ++k) values.push_back(read_number(p.type, element, row));
    return values;
  }

  void add_face(const std::vector<double>& corners, std::size_t row) {
    std::vector<int> loop;
    for (const double corner : corners) {
      if (!(corner >= 0.0 && corner < double(surface_.vertices.size())) || corner != std::floor(corner))
        fail(fmt::format("face {}: corner {} is not one of the {} vertices above, counted from 0", row, corner,
                         surface_.vertices.size()));
      loop.push_back(int(corner));
    }
    if (loop.size() < 3) fail(fmt::format("face {} has {}; it needs at least 3", row, counted(loop.size(), "corner")));
    surface_.objects[0].faces.push_back(int(surface_.faces.size()));
    surface_.faces.push_back(std::move(loop));
    surface_.face_lines.push_back(form_ == Form::text ? line_ : 0);
    if (surface_.faces.size() == 1) surface_.objects[0].line = surface_.face_lines[0];
  }

  double read_number(const Type& type, const Element& element, std::size_t row) {
    if (form_ == Form::text) return read_word(element, row);
    if (type.bytes > bytes_.size() - at_) cut_off(element, row);
    unsigned char raw[8];
    std::memcpy(raw, bytes_.data() + at_, type.bytes);
    at_ += type.bytes;
    static_assert(std::endian::native == std::endian::little);
    if (form_ == Form::big) std::reverse(raw, raw + type.bytes);
    return value_of(type, raw);
  }

  template <class Number>
  static double as(const unsigned char* raw) {
    Number value;
    std::memcpy(&value, raw, sizeof value);
    return double(value);
  }

  static double value_of(const Type& type, const unsigned char* raw) {
    if (type.floating) return type.bytes == 4 ? as<float>(raw) : as<double>(raw);
    if (type.bytes == 1) return type.is_signed ? as<std::int8_t>(raw) : as<std::uint8_t>(raw);
    if (type.bytes == 2) return type.is_signed ? as<std::int16_t>(raw) : as<std::uint16_t>(raw);
    return type.is_signed ? as<std::int32_t>(raw) : as<std::uint32_t>(raw);
  }

  double read_word(const Element& element, std::size_t row) {
    for (; at_ < bytes_.size() && std::isspace(static_cast<unsigned char>(bytes_[at_])); ++at_)
      line_ += bytes_[at_] == '\n';
    if (at_ == bytes_.size()) cut_off(element, row);
    const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n", at_), bytes_.size());
    const char* begin = bytes_.data() + at_ + (bytes_[at_] == '+');
    double value = 0.0;
    const auto [stop, error] = std::from_chars(begin, bytes_.data() + end, value);
    if (error != std::errc{} || stop != bytes_.data() + end)
      fail(fmt::format("{} {} has no number where one is needed", shown(element.name), row));
    at_ = end;
    return value;
  }

  [[noreturn]] void cut_off(const Element& element, std::size_t row) const {
    fail(fmt::format("the file ends within {} {} of {}: export it again", shown(element.name), row, element.count));
  }

  std::string path_;
  const std::string& bytes_;
  std::size_t at_ = 0, line_ = 0;
  Form form_ = Form::text;
  std::vector<Element> elements_;
  Surface surface_;
};

}  // namespace

Surface parse_ply(const std::string& bytes, const std::string& path) {
  return PlyReader(bytes, path).read();
}

}  // namespace voussoir

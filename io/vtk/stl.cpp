// Our own reader: VTK's trusts the counts in a damaged file, and drops the names of solids.
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <string_view>

#include "io/vtk/surface_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/words.h"

namespace voussoir {
namespace {

constexpr std::size_t head_size = 84, facet_size = 50;  // bytes of a binary file: name and count; facet

/// Collects facets; corners with the very same coordinates are one vertex.
class Facets {
 public:
  explicit Facets(std::string path) : path_(std::move(path)) {}

  void begin_object(const std::string& name) { surface_.objects.push_back({name, 0, {}}); }
  int vertex(const Vec3& point) {
    const auto [entry, fresh] = known_.try_emplace({point.x(), point.y(), point.z()}, int(surface_.vertices.size()));
    if (fresh) surface_.vertices.push_back(point);
    return entry->second;
  }
  void face(std::vector<int> loop, std::size_t line) {
    if (surface_.objects.empty()) begin_object("");
    FileObject& object = surface_.objects.back();
    if (object.faces.empty()) object.line = line;
    object.faces.push_back(int(surface_.faces.size()));
    surface_.faces.push_back(std::move(loop));
    surface_.face_lines.push_back(line);
  }
  Surface finish() {
    std::erase_if(surface_.objects, [](const FileObject& object) { return object.faces.empty(); });
    return std::move(surface_);
  }
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw InputError("{}:{}: {}", path_, line, what);
  }

 private:
  std::string path_;
  Surface surface_;
  std::map<std::array<double, 3>, int> known_;
};

float float_at(const std::string& bytes, std::size_t at) {
  static_assert(std::endian::native == std::endian::little);
  float value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::uint32_t count_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

Surface read_binary(const std::string& path, const std::string& bytes) {
  Facets facets(path);
  const std::size_t count = count_at(bytes, head_size - 4);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<int> loop;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t at = head_size + i * facet_size + 12 * (corner + 1);  // after the normal
      const Vec3 point(float_at(bytes, at), float_at(bytes, at + 4), float_at(bytes, at + 8));
      if (!point.allFinite()) throw InputError("{}: facet {} has a corner that is not a finite number", path, i);
      loop.push_back(facets.vertex(point));
    }
    facets.face(std::move(loop), 0);
  }
  Surface surface = facets.finish();
  if (const std::size_t end = head_size + count * facet_size; end < bytes.size())
    surface.notes.push_back(
        fmt::format("{}: the {} bytes after its {} were ignored", path, bytes.size() - end, counted(count, "facet")));
  return surface;
}

bool is(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](unsigned char a, char b) { return std::tolower(a) == b; });
}

Vec3 corner_of(const std::vector<std::string_view>& words, std::size_t line, const Facets& facets) {
  Vec3 point = Vec3::Constant(NAN);
  for (std::size_t k = 0; k < 3 && words.size() > k + 1; ++k) {
    std::string_view word = words[k + 1];
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), point[Eigen::Index(k)]);
    if (error != std::errc{} || end != word.data() + word.size()) point[Eigen::Index(k)] = NAN;
  }
  if (!point.allFinite()) facets.fail(line, "a vertex needs three finite numbers, as in 'vertex 0.0 1.0 2.0'");
  return point;
}

Surface read_text_form(const std::string& path, std::string_view text) {
  Facets facets(path);
  std::vector<int> loop;
  std::size_t line = 0, loop_line = 0;
  while (!text.empty()) {
    ++line;
    const std::size_t end = text.find('\n');
    const auto words = words_of(text.substr(0, end), " \t\r");
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (words.empty()) continue;
    if (is(words[0], "solid")) {
      facets.begin_object(words.size() > 1 ? std::string(words[1].data(), words.back().end()) : "");
    } else if (is(words[0], "facet")) {
      loop.clear();
      loop_line = line;
    } else if (is(words[0], "vertex")) {
      loop.push_back(facets.vertex(corner_of(words, line, facets)));
    } else if (is(words[0], "endfacet")) {
      if (loop.size() < 3) facets.fail(loop_line, "a facet needs three corners or more");
      facets.face(std::move(loop), loop_line);
      loop.clear();
    } else if (!is(words[0], "outer") && !is(words[0], "endloop") && !is(words[0], "endsolid")) {
      facets.fail(line,
                  "this line must begin with an STL keyword (facet, outer loop, vertex, endloop, endfacet, endsolid)");
    }
  }
  if (!loop.empty()) facets.fail(loop_line, "the facet is cut off: export the file again");
  return facets.finish();
}

/// A text whose bytes at the place of the count are 0, which a binary file without facets has too.
bool is_text_form(const std::string& bytes, std::size_t count) {
  return count == 0 && bytes.find("facet") != std::string::npos;
}

}  // namespace

Surface parse_stl(const std::string& bytes, const std::string& path) {
  // Binary files may begin with "solid" too. The count tells: where a text has letters, it would need gigabytes.
  const std::size_t count = bytes.size() >= head_size ? count_at(bytes, head_size - 4) : 0;
  if (bytes.size() >= head_size && count <= (bytes.size() - head_size) / facet_size && !is_text_form(bytes, count))
    return read_binary(path, bytes);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && is(std::string_view(bytes).substr(first, 5), "solid"))
    return read_text_form(path, bytes);
  throw InputError(
      "{}: is not an STL file, or is cut off: it neither begins with 'solid' nor has the length that its number of "
      "facets needs. Export it again.",
      path);
}

}  // namespace voussoir
